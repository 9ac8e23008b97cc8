#include "fracture/fracture.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

FractureSettings into(int pieces) {
  FractureSettings settings;
  settings.pieces = pieces;
  return settings;
}

PaneSettings paneOf(int points, const Triangulation& method) {
  PaneSettings pane;
  pane.outline = RectangleOutline{1.4, 0.9};
  pane.points = points;
  pane.triangulation = method;
  return pane;
}

/// Every edge once in each direction, one part, and around every vertex one fan: two triangles to each vertex's edge,
/// so with V - E + F even, and as many vertices as the fans need.
void expectSolidShard(const Piece& piece, double thickness) {
  EXPECT_TRUE(isClosed(piece.mesh));
  EXPECT_EQ(componentCount(piece.mesh), 1);
  EXPECT_TRUE(piece.mesh.normals.empty());
  const MassProperties p = solidProperties(piece.mesh);
  const Vec3d size = bounds(piece.mesh).size();
  // Moving to the centroid rounds coordinates of about 1 m: 1e-16 m in each of the lengths a volume is made of.
  const double rounding = 1e-15 * (size.x + size.y) * thickness;
  double flatArea = 0;
  for (const auto& [a, b, c] : piece.mesh.triangles) {
    const Vec3d n =
        cross(piece.mesh.vertices[b] - piece.mesh.vertices[a], piece.mesh.vertices[c] - piece.mesh.vertices[a]);
    flatArea += std::max(0.0, n.z) / 2;
  }
  EXPECT_NEAR(p.volume, flatArea * thickness, 1e-12 * p.volume + 10 * rounding);
  EXPECT_GT(p.volume, 0);
  EXPECT_NEAR(p.volume, piece.properties.volume, 1e-12 * p.volume + 10 * rounding);
  EXPECT_LT(length(p.centroid), 1e-12);
  EXPECT_EQ(piece.properties.centroid, (Vec3d{}));
  for (int axis = 0; axis < 3; ++axis) EXPECT_GT(piece.properties.inertia.row[axis][axis], 0);
  EXPECT_GT(determinant(piece.properties.inertia), 0);
}

double totalVolume(const FracturedBody& body) {
  double sum = 0;
  for (const Piece& piece : body.pieces) sum += piece.properties.volume;
  return sum;
}

TEST(FracturePane, MakesSolidShardsThatAddUpToThePane) {
  for (const Triangulation& method : {Triangulation{Trisection{}}, Triangulation{Delaunay{}}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (int pieces = 1; pieces <= 40; ++pieces) {
        const PaneSettings pane = paneOf(120, method);
        const FracturedBody body = fracturePane(pane, into(pieces), seed);
        ASSERT_EQ(static_cast<int>(body.pieces.size()), pieces);
        for (const Piece& piece : body.pieces) expectSolidShard(piece, pane.thickness);
        // Border points move by half a lattice step at most: 2^-30 of 1.4 m on each side.
        EXPECT_NEAR(totalVolume(body), 1.4 * 0.9 * 0.005, 1e-8 * 0.005);
      }
}

TEST(FracturePane, MakesManySolidShards) {
  for (const Triangulation& method : {Triangulation{Trisection{}}, Triangulation{Delaunay{}}}) {
    const PaneSettings pane = paneOf(2000, method);
    const FracturedBody body = fracturePane(pane, into(512), 1);
    ASSERT_EQ(body.pieces.size(), 512u);
    for (const Piece& piece : body.pieces) expectSolidShard(piece, pane.thickness);
    EXPECT_NEAR(totalVolume(body), 1.4 * 0.9 * 0.005, 1e-8 * 0.005);
  }
}

TEST(FracturePane, LeavesThePaneBalancedAboutItsPlaces) {
  const FracturedBody body = fracturePane(paneOf(200, Trisection{}), into(16), 5);
  Vec3d moment;
  for (const Piece& piece : body.pieces) {
    moment += piece.place * piece.properties.volume;
    EXPECT_NEAR(piece.place.z, 0, 1e-15);
  }
  EXPECT_LT(length(moment), 1e-9 * 0.0063);
}

TEST(FracturePane, WithoutPointsInsideStillBreaks) {
  PaneSettings pane = paneOf(0, Trisection{});
  const FracturedBody body = fracturePane(pane, into(2), 1);
  ASSERT_EQ(body.pieces.size(), 2u);
  for (const Piece& piece : body.pieces) expectSolidShard(piece, pane.thickness);
  ASSERT_EQ(body.bonds.size(), 1u);
  EXPECT_NEAR(body.bonds[0].area, std::hypot(1.4, 0.9) * 0.005, 1e-10);
  EXPECT_THROW(fracturePane(pane, into(3), 1), InputError);
}

TEST(FracturePane, BondsHoldTheCutSurfaceAndPointAcross) {
  for (const Triangulation& method : {Triangulation{Trisection{}}, Triangulation{Delaunay{}}}) {
    const PaneSettings pane = paneOf(200, method);
    const FracturedBody body = fracturePane(pane, into(24), 3);
    double surface = 0, bonded = 0;
    for (const Piece& piece : body.pieces) surface += piece.properties.area;
    for (const Bond& bond : body.bonds) {
      EXPECT_LT(bond.a, bond.b);
      EXPECT_NEAR(length(bond.normal), 1, 1e-12);
      EXPECT_NEAR(bond.normal.z, 0, 1e-12);
      bonded += bond.area;
    }
    // Every surface is the pane's own or one side of a bond.
    const double whole = 2 * 1.4 * 0.9 + 2 * (1.4 + 0.9) * pane.thickness;
    EXPECT_NEAR(surface, whole + 2 * bonded, 1e-7);
  }
}

TEST(FracturePane, BondNormalsPointFromTheFirstToTheSecond) {
  const FracturedBody body = fracturePane(paneOf(200, Delaunay{}), into(2), 4);
  ASSERT_EQ(body.bonds.size(), 1u);
  EXPECT_GT(dot(body.bonds[0].normal, body.pieces[1].place - body.pieces[0].place), 0);
}

TEST(FracturePane, IsTheSameForASeedAndAnotherForAnother) {
  const PaneSettings pane = paneOf(100, Trisection{});
  const FracturedBody once = fracturePane(pane, into(9), 1), again = fracturePane(pane, into(9), 1);
  for (std::size_t i = 0; i < once.pieces.size(); ++i) {
    EXPECT_EQ(once.pieces[i].mesh, again.pieces[i].mesh);
    EXPECT_EQ(once.pieces[i].place, again.pieces[i].place);
  }
  EXPECT_NE(once.pieces[0].mesh, fracturePane(pane, into(9), 2).pieces[0].mesh);
}

TEST(FractureMesh, LeavesAClosedBodyWholeAndSolid) {
  TriangleMesh box = boxMesh({1, 2, 3}, true);
  recenter(box, {-5, 0, 0.5});
  const FracturedBody body = fractureMesh(box, into(1), 0.01);
  ASSERT_EQ(body.pieces.size(), 1u);
  EXPECT_TRUE(body.bonds.empty());
  EXPECT_NEAR(body.pieces[0].properties.volume, 6, 1e-13);
  EXPECT_LT(length(body.pieces[0].place - Vec3d{5, 0, -0.5}), 1e-13);
  EXPECT_EQ(body.pieces[0].mesh.triangles, box.triangles);
  EXPECT_EQ(body.pieces[0].mesh.uvs, box.uvs);
}

TEST(FractureMesh, TurnsABodyRightSideOut) {
  TriangleMesh box = boxMesh({1, 2, 3}, true);
  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  for (Vec3d& n : box.normals) n = -n;
  const Piece piece = fractureMesh(box, into(1), 0.01).pieces[0];
  EXPECT_NEAR(piece.properties.volume, 6, 1e-13);
  EXPECT_NEAR(solidProperties(piece.mesh).volume, 6, 1e-13);
  EXPECT_EQ(piece.mesh.normals, boxMesh({1, 2, 3}, true).normals);
}

TEST(FractureMesh, LeavesAnOpenBodyAShell) {
  const FracturedBody body = fractureMesh(rectangleMesh(2, 3), into(1), 0.01);
  EXPECT_NEAR(body.pieces[0].properties.volume, 0.06, 1e-14);
}

TEST(FractureMesh, CutsASphereIntoShellsThatAddUp) {
  TriangleMesh sphere = sphereMesh(0.5, 48, true);
  sphere.materialNames = {"north", "south"};
  for (const Triangle& t : sphere.triangles) sphere.materials.push_back(sphere.vertices[t[0]].y < 0);
  const MassProperties whole = shellProperties(sphere, 0.02);
  const FracturedBody body = fractureMesh(sphere, into(12), 0.02);
  ASSERT_EQ(body.pieces.size(), 12u);
  double volume = 0;
  std::size_t triangles = 0;
  for (const Piece& piece : body.pieces) {
    volume += piece.properties.volume;
    triangles += piece.mesh.triangles.size();
    EXPECT_EQ(componentCount(welded(piece.mesh)), 1) << "the seam of the picture is no crack";
    ASSERT_EQ(piece.mesh.normals.size(), piece.mesh.vertices.size());
    ASSERT_EQ(piece.mesh.uvs.size(), piece.mesh.vertices.size());
    ASSERT_EQ(piece.mesh.materials.size(), piece.mesh.triangles.size());
    // The normal of a sphere's point is its direction, whatever piece it went to.
    for (std::size_t v = 0; v < piece.mesh.vertices.size(); ++v)
      EXPECT_LT(length((piece.mesh.vertices[v] + piece.place) * 2.0 - piece.mesh.normals[v]), 1e-14);
  }
  EXPECT_EQ(triangles, sphere.triangles.size());
  EXPECT_NEAR(volume, whole.volume, 1e-13);
}

TEST(FractureMesh, BondsLieInTheSurface) {
  const FracturedBody body = fractureMesh(sphereMesh(0.5, 48, false), into(2), 0.02);
  ASSERT_EQ(body.bonds.size(), 1u);
  // The shortest way around is a great circle; a ragged one is longer, but not twice for halves by breadth-first order.
  EXPECT_GT(body.bonds[0].area, 0.9 * pi * 0.02);
  EXPECT_LT(body.bonds[0].area, 2 * pi * 0.02);
  EXPECT_NEAR(length(body.bonds[0].normal), 1, 1e-12);
  EXPECT_GT(dot(body.bonds[0].normal, body.pieces[1].place - body.pieces[0].place), 0);
}

TEST(FractureMesh, RefusesMorePiecesThanTriangles) {
  EXPECT_THROW(fractureMesh(boxMesh({1, 1, 1}), into(13), 0.01), InputError);
}

}  // namespace
}  // namespace brisance
