#include "mesh/mass_properties.h"

#include <gtest/gtest.h>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

// Sums of a few dozen terms of the size of the result: some tens of roundings of 1.1e-16 each.
constexpr double rounding = 1e-14;

const Pose tilted{{3, -2, 5}, axisAngle(normalized(Vec3d{1, 2, -1}), 0.7)};

TEST(MassProperties, OfABoxAreThoseOfTheTextbook) {
  const Vec3d s{2, 3, 0.5};
  const MassProperties p = solidProperties(boxMesh(s, false));
  EXPECT_NEAR(p.volume, 3, 3 * rounding);
  EXPECT_NEAR(p.area, 2 * (6 + 1.5 + 1), 17 * rounding);
  EXPECT_LT(length(p.centroid), rounding);
  const Vec3d expected{9.25 * 3 / 12, 4.25 * 3 / 12, 13.0 * 3 / 12};
  EXPECT_LT(largestDifference(p.inertia, Mat3{{{expected.x, 0, 0}, {0, expected.y, 0}, {0, 0, expected.z}}}),
            5 * rounding);
}

TEST(MassProperties, OfABoxDoNotDependOnDoubledVertices) {
  const MassProperties bare = solidProperties(boxMesh({2, 3, 0.5}, false));
  const MassProperties textured = solidProperties(boxMesh({2, 3, 0.5}, true));
  EXPECT_NEAR(bare.volume, textured.volume, 3 * rounding);
  EXPECT_LT(largestDifference(bare.inertia, textured.inertia), 5 * rounding);
}

TEST(MassProperties, OfATetrahedronAreExact) {
  const MassProperties p = solidProperties(cornerTetrahedron());
  EXPECT_NEAR(p.volume, 1.0 / 6, rounding);
  EXPECT_LT(length(p.centroid - Vec3d{0.25, 0.25, 0.25}), rounding);
  // Integrals over the tetrahedron: x^2 1/60, xy 1/120; about the centroid less V/16 each.
  const double square = 1.0 / 60 - 1.0 / 96, product = 1.0 / 120 - 1.0 / 96;
  const double d = 2 * square, o = -product;
  EXPECT_LT(largestDifference(p.inertia, Mat3{{{d, o, o}, {o, d, o}, {o, o, d}}}), rounding);
}

TEST(MassProperties, TurnAndMoveWithTheBody) {
  const TriangleMesh mesh = cornerTetrahedron();
  const MassProperties still = solidProperties(mesh), turned = solidProperties(moved(mesh, tilted));
  const Mat3 r = rotationMatrix(tilted.orientation);
  EXPECT_NEAR(turned.volume, still.volume, rounding);
  EXPECT_LT(length(turned.centroid - tilted * still.centroid), 6 * rounding);
  EXPECT_LT(largestDifference(turned.inertia, r * still.inertia * transpose(r)), rounding);
}

TEST(MassProperties, FarFromTheOriginKeepTheirDigits) {
  const MassProperties p = solidProperties(moved(boxMesh({1, 1, 1}, false), {{1e6, -1e6, 1e6}, {}}));
  // A coordinate near 1e6 is rounded to 1.2e-10; inertia is that of a box whose sides carry such an error.
  EXPECT_NEAR(p.volume, 1, 1e-9);
  EXPECT_LT(largestDifference(p.inertia, Mat3{} * (1.0 / 6)), 1e-9);
}

TEST(MassProperties, OfAMirroredBodyAreMirrored) {
  const MassProperties p = solidProperties(cornerTetrahedron()), m = solidProperties(mirrored(cornerTetrahedron()));
  EXPECT_NEAR(m.volume, p.volume, rounding);
  EXPECT_NEAR(m.centroid.x, -p.centroid.x, rounding);
  EXPECT_NEAR(m.inertia.row[0].y, -p.inertia.row[0].y, rounding);
  EXPECT_NEAR(m.inertia.row[1].z, p.inertia.row[1].z, rounding);
}

TEST(MassProperties, DoNotChangeWhenAFaceIsSubdivided) {
  const TriangleMesh mesh = moved(boxMesh({2, 3, 0.5}, false), tilted);
  TriangleMesh finer = withTriangleSplit(mesh, 4, {0.7, 0.2, 0.1});
  for (std::size_t i = 0; i < 40; ++i) finer = withTriangleSplit(finer, 12 + i, {0.25, 0.25, 0.5});
  for (const double thickness : {0.0, 0.01}) {
    const auto of = [&](const TriangleMesh& m) {
      return thickness == 0 ? solidProperties(m) : shellProperties(m, thickness);
    };
    EXPECT_NEAR(of(finer).volume, of(mesh).volume, 30 * rounding);
    EXPECT_NEAR(of(finer).area, of(mesh).area, 170 * rounding);
    EXPECT_LT(length(of(finer).centroid - of(mesh).centroid), 60 * rounding);
    EXPECT_LT(largestDifference(of(finer).inertia, of(mesh).inertia), 100 * rounding);
  }
}

TEST(MassProperties, OfAFineSphereApproachTheTextbookAtSecondOrder) {
  const double r = 1.5, volume = 4.0 / 3 * pi * r * r * r, inertia = 0.4 * volume * r * r;
  const auto errors = [&](int segments) {
    const MassProperties p = solidProperties(sphereMesh(r, segments, false));
    return std::pair{volume - p.volume, inertia - p.inertia.row[1].y};
  };
  const auto coarse = errors(32), fine = errors(64);
  // Twice the segments, a quarter of the error; the next term is some percent of it at 32 segments.
  EXPECT_NEAR(coarse.first / fine.first, 4, 0.1);
  EXPECT_NEAR(coarse.second / fine.second, 4, 0.1);
  EXPECT_GT(fine.first, 0) << "the polyhedron is inscribed";
}

TEST(MassProperties, OfAHollowSphereAreTwoThirds) {
  const double r = 0.8, thickness = 0.01;
  const MassProperties p = shellProperties(sphereMesh(r, 256, false), thickness);
  const double mass = 4 * pi * r * r * thickness;
  // The inscribed net of 256 segments lacks (2 pi / 256)^2 / 8 of the radius at most: 0.3 % in a moment of fourth
  // order.
  EXPECT_NEAR(p.volume, mass, 0.003 * mass);
  EXPECT_NEAR(p.inertia.row[0].x, 2.0 / 3 * mass * r * r, 0.003 * mass);
}

TEST(MassProperties, OfAFlatShellAreThoseOfALamina) {
  const MassProperties p = shellProperties(rectangleMesh(2, 3), 0.01);
  EXPECT_NEAR(p.area, 6, 6 * rounding);
  EXPECT_NEAR(p.volume, 0.06, rounding);
  const Mat3 lamina{{{0.06 * 9 / 12, 0, 0}, {0, 0.06 * 4 / 12, 0}, {0, 0, 0.06 * 13 / 12}}};
  EXPECT_LT(largestDifference(p.inertia, lamina), rounding);
}

TEST(MassProperties, OfABodyTurnedInsideOutAreNegative) {
  TriangleMesh mesh = cornerTetrahedron();
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  const MassProperties p = solidProperties(mesh);
  EXPECT_NEAR(p.volume, -1.0 / 6, rounding);
  EXPECT_LT(length(p.centroid - Vec3d{0.25, 0.25, 0.25}), rounding);
}

}  // namespace
}  // namespace brisance
