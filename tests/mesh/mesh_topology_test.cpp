#include "mesh/mesh_topology.h"

#include <gtest/gtest.h>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + shift, j + shift, k + shift});
  return a;
}

TEST(MeshTopology, NeighboursShareTheEdgeThatJoinsThem) {
  const TriangleMesh mesh = sphereMesh(1, 12, false);
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh);
  ASSERT_EQ(neighbours.size(), mesh.triangles.size());
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (int edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = neighbours[t][edge];
      ASSERT_NE(other, noTriangle);
      int back = 0;
      while (back < 3 && neighbours[other][back] != t) ++back;
      ASSERT_LT(back, 3);
      EXPECT_EQ(mesh.triangles[t][edge], mesh.triangles[other][(back + 1) % 3]);
      EXPECT_EQ(mesh.triangles[t][(edge + 1) % 3], mesh.triangles[other][back]);
    }
}

TEST(MeshTopology, AnEdgeOfThreeTrianglesPairsTheFirstTwo) {
  TriangleMesh fin;
  fin.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  fin.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const std::vector<Triangle> neighbours = edgeNeighbours(fin);
  EXPECT_EQ(neighbours[0][0], 1u);
  EXPECT_EQ(neighbours[1][0], 0u);
  EXPECT_EQ(neighbours[2][0], noTriangle);
  EXPECT_FALSE(isClosed(fin));
}

TEST(MeshTopology, AClosedMeshIsClosedAndStopsBeingSoWithoutATriangle) {
  for (TriangleMesh mesh : {cornerTetrahedron(), boxMesh({1, 2, 3}, false), sphereMesh(2, 16, false)}) {
    EXPECT_TRUE(isClosed(mesh));
    EXPECT_TRUE(isClosed(mirrored(mesh)));
    TriangleMesh open = mesh;
    open.triangles.pop_back();
    EXPECT_FALSE(isClosed(open));
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    EXPECT_FALSE(isClosed(mesh)) << "one triangle faces inwards";
  }
  EXPECT_FALSE(isClosed(rectangleMesh(1, 1)));
  EXPECT_FALSE(isClosed(TriangleMesh{}));
}

TEST(MeshTopology, WeldingClosesATexturedBox) {
  const TriangleMesh textured = boxMesh({1, 2, 3}, true);
  EXPECT_FALSE(isClosed(textured));
  EXPECT_EQ(componentCount(textured), 6);
  const TriangleMesh bare = welded(textured);
  EXPECT_TRUE(isClosed(bare));
  EXPECT_EQ(componentCount(bare), 1);
  ASSERT_EQ(bare.triangles.size(), textured.triangles.size());
  for (std::size_t t = 0; t < bare.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(bare.vertices[bare.triangles[t][corner]], textured.vertices[textured.triangles[t][corner]]);
}

TEST(MeshTopology, ComponentsAreCountedAcrossEdgesNotVertices) {
  EXPECT_EQ(componentCount(joined(cornerTetrahedron(), cornerTetrahedron())), 2);
  TriangleMesh bowTie;
  bowTie.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bowTie.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(componentCount(bowTie), 2);
  EXPECT_EQ(componentCount(TriangleMesh{}), 0);
}

TEST(MeshTopology, AVertexNumberBeyondTheListIsCaught) {
  EXPECT_THROW(edgeNeighbours({{0, 1, 3}}, 3), std::logic_error);
}

TEST(MeshTopology, ATriangleThatRepeatsAVertexTouchesNothingAcrossThatEdge) {
  const std::vector<Triangle> neighbours = edgeNeighbours({{0, 0, 1}, {0, 1, 2}}, 3);
  EXPECT_EQ(neighbours[0][0], noTriangle);
}

TEST(TriangleMesh, BoundsHoldEveryVertexAndMoveWithThem) {
  TriangleMesh mesh = cornerTetrahedron();
  EXPECT_EQ(bounds(mesh).lower, (Vec3d{0, 0, 0}));
  EXPECT_EQ(bounds(mesh).upper, (Vec3d{1, 1, 1}));
  recenter(mesh, {0.5, -1, 0.25});
  EXPECT_EQ(bounds(mesh).lower, (Vec3d{-0.5, 1, -0.25}));
  EXPECT_EQ(bounds(mesh).upper, (Vec3d{0.5, 2, 0.75}));
}

TEST(MeshTopology, BoxesThatShareAnEdgeAreWatertightButNotAManifold) {
  TriangleMesh boxes = boxMesh({1, 1, 1}, false);
  const TriangleMesh other = boxes;
  const auto shift = static_cast<std::uint32_t>(boxes.vertices.size());
  for (const Vec3d& v : other.vertices) boxes.vertices.push_back(v + Vec3d(1, 1, 0));
  for (const auto& [a, b, c] : other.triangles) boxes.triangles.push_back({a + shift, b + shift, c + shift});
  const TriangleMesh joined = welded(boxes);
  EXPECT_FALSE(isClosed(joined));
  EXPECT_TRUE(isWatertight(joined));
  TriangleMesh open = joined;
  open.triangles.pop_back();
  EXPECT_FALSE(isWatertight(open));
  EXPECT_FALSE(isWatertight({}));
}

}  // namespace
}  // namespace brisance
