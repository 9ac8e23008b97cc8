#include "mesh/canonical_order.h"

#include <gtest/gtest.h>

#include "assets/sample_meshes.h"
#include "mesh/shapes.h"
#include "scrambled_mesh.h"

namespace brisance {
namespace {

TEST(CanonicalOrder, IsTheSameForAScrambledMesh) {
  for (const TriangleMesh& mesh : {samples::bumpySphere(2000), samples::torus(1000), boxMesh({1, 2, 3}, false)}) {
    const OrderedSurface ordered = inCanonicalOrder(mesh);
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const OrderedSurface again = inCanonicalOrder(scrambled(mesh, seed).mesh);
      EXPECT_EQ(ordered.mesh.vertices, again.mesh.vertices);
      EXPECT_EQ(ordered.mesh.triangles, again.mesh.triangles);
    }
  }
}

TEST(CanonicalOrder, TellsWhereEachTriangleCameFrom) {
  const TriangleMesh mesh = scrambled(samples::bumpySphere(500), 7).mesh;
  const OrderedSurface ordered = inCanonicalOrder(mesh);
  ASSERT_EQ(ordered.triangleOf.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < ordered.triangleOf.size(); ++t) {
    const Triangle &now = ordered.mesh.triangles[t], &before = mesh.triangles[ordered.triangleOf[t]];
    // The same corners in the same turn, from some corner on.
    const auto place = [&](std::uint32_t v) { return ordered.mesh.vertices[v]; };
    int turns = 0;
    for (std::size_t turn = 0; turn < 3; ++turn)
      turns += place(now[0]) == mesh.vertices[before[turn]] && place(now[1]) == mesh.vertices[before[(turn + 1) % 3]] &&
               place(now[2]) == mesh.vertices[before[(turn + 2) % 3]];
    EXPECT_EQ(turns, 1) << t;
  }
}

TEST(CanonicalOrder, LeavesOutVerticesThatServeNoTriangle) {
  TriangleMesh mesh = boxMesh({1, 1, 1}, false);
  mesh.vertices.push_back({100, 100, 100});
  EXPECT_EQ(inCanonicalOrder(mesh).mesh.vertices.size(), mesh.vertices.size() - 1);
}

TEST(CanonicalOrder, PutsNeighboursCloseTogether) {
  const TriangleMesh mesh = scrambled(samples::bumpySphere(20000), 3).mesh;
  const auto meanStep = [](const TriangleMesh& m) {
    double sum = 0;
    for (std::size_t v = 1; v < m.vertices.size(); ++v) sum += length(m.vertices[v] - m.vertices[v - 1]);
    return sum / static_cast<double>(m.vertices.size());
  };
  EXPECT_LT(meanStep(inCanonicalOrder(mesh).mesh), meanStep(mesh) / 20);
}

TEST(CanonicalOrder, TakesAMeshOfNothingAndOfOnePoint) {
  EXPECT_TRUE(inCanonicalOrder({}).mesh.triangles.empty());
  TriangleMesh point;
  point.vertices.assign(3, {1, 1, 1});
  point.triangles = {{0, 1, 2}};
  EXPECT_EQ(inCanonicalOrder(point).mesh.triangles.size(), 1u);
}

}  // namespace
}  // namespace brisance
