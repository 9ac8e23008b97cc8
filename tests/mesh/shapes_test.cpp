#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include "mesh/mass_properties.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

/// Every triangle turns the way its corners' normals point.
void expectNormalsAgree(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d n = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    for (const std::uint32_t v : {a, b, c}) EXPECT_GT(dot(n, mesh.normals[v]), 0);
  }
  for (const Vec3d& n : mesh.normals) EXPECT_NEAR(length(n), 1, 1e-14);
}

/// The picture is not mirrored: u to the right, v upwards, seen from outside.
void expectUvsTurnLeft(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.uvs.size(), mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2d ab = mesh.uvs[b] - mesh.uvs[a], ac = mesh.uvs[c] - mesh.uvs[a];
    EXPECT_GT(ab.x * ac.y - ab.y * ac.x, 0);
  }
}

TEST(Shapes, FaceOutwardsWithPicturesTheRightWayRound) {
  for (const TriangleMesh& mesh : {sphereMesh(2, 24), boxMesh({1, 2, 3}), rectangleMesh(2, 1)}) {
    expectNormalsAgree(mesh);
    expectUvsTurnLeft(mesh);
  }
}

TEST(Shapes, WeldedFormsAreClosedAndBoundTheSameVolume) {
  for (const int segments : {4, 5, 16, 33}) {
    const TriangleMesh sphere = sphereMesh(1.5, segments, false);
    expectNormalsAgree(sphere);
    EXPECT_TRUE(isClosed(sphere));
    EXPECT_NEAR(solidProperties(sphere).volume, solidProperties(sphereMesh(1.5, segments, true)).volume, 1e-13);
  }
  EXPECT_TRUE(isClosed(boxMesh({1, 2, 3}, false)));
  EXPECT_NEAR(solidProperties(boxMesh({1, 2, 3}, true)).volume, 6, 1e-13);
}

TEST(Shapes, SeamOfASphereMeetsItself) {
  // Welding by place closes the textured sphere: the seam's two columns are the same bits.
  EXPECT_TRUE(isClosed(welded(sphereMesh(1, 12, true))));
}

TEST(Shapes, SphereCarriesThePictureOfTheThesis) {
  const TriangleMesh sphere = sphereMesh(1, 16);
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    const Vec3d& p = sphere.vertices[i];
    const Vec2d uv = sphere.uvs[i];
    EXPECT_NEAR(1 - uv.y, std::acos(std::clamp(p.y, -1.0, 1.0)) / pi, 1e-7);  // acos near 1: half the digits
    if (std::abs(p.y) > 0.99) continue;
    // Counter-clockwise around y from +x.
    EXPECT_NEAR(std::cos(2 * pi * uv.x), p.x / std::hypot(p.x, p.z), 1e-13);
    EXPECT_NEAR(std::sin(2 * pi * uv.x), -p.z / std::hypot(p.x, p.z), 1e-13);
  }
}

TEST(Shapes, RepeatPicturesAsAsked) {
  for (const TriangleMesh& mesh : {boxMesh({1, 2, 3}, true, {4, 3}), rectangleMesh(1, 2, {4, 3})}) {
    Vec2d largest;
    for (const Vec2d& uv : mesh.uvs) largest = {std::max(largest.x, uv.x), std::max(largest.y, uv.y)};
    EXPECT_EQ(largest, (Vec2d{4, 3}));
  }
}

TEST(Shapes, HaveTheSizesAsked) {
  EXPECT_EQ(bounds(boxMesh({1, 2, 3})).size(), (Vec3d{1, 2, 3}));
  EXPECT_EQ(bounds(boxMesh({1, 2, 3}, false)).size(), (Vec3d{1, 2, 3}));
  EXPECT_EQ(bounds(rectangleMesh(4, 5)).size(), (Vec3d{4, 5, 0}));
  for (const Vec3d& v : sphereMesh(2.5, 20).vertices) EXPECT_NEAR(length(v), 2.5, 1e-14);
}

}  // namespace
}  // namespace brisance
