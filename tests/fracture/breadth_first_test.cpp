#include "fracture/breadth_first.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "base/check.h"
#include "base/random.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"
#include "mesh/triangulation.h"

namespace brisance {
namespace {

std::vector<int> sizes(const Partition& partition) {
  std::vector<int> result(partition.count, 0);
  for (const int piece : partition.pieceOf) ++result.at(piece);
  return result;
}

/// Islands over all pieces: as many as pieces when each is connected.
int islands(const FractureGraph& graph, const Partition& partition) {
  std::vector<bool> seen(graph.nodeCount(), false);
  int count = 0;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++count;
    std::vector<std::uint32_t> open{start};
    seen[start] = true;
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const std::uint32_t next : graph.neighbours(node))
        if (!seen[next] && partition.pieceOf[next] == partition.pieceOf[node]) {
          seen[next] = true;
          open.push_back(next);
        }
    }
  }
  return count;
}

void expectValid(const FractureGraph& graph, const Partition& partition, int pieces) {
  ASSERT_EQ(static_cast<int>(partition.pieceOf.size()), graph.nodeCount());
  EXPECT_EQ(partition.count, pieces);
  for (const int size : sizes(partition)) EXPECT_GT(size, 0);
  EXPECT_EQ(islands(graph, partition), pieces);
}

FractureGraph paneGraph(int points, const Triangulation& method, std::uint64_t seed) {
  const FlatMesh flat = triangulate(panePoints(1, 1, points, points / 10, seed), method, seed);
  return triangleGraph(flat.triangles, flat.points.size());
}

/// A chain of nodes 0 - 1 - ... - n-1.
FractureGraph chain(std::uint32_t n) {
  FractureGraph graph;
  graph.first.push_back(0);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i > 0) graph.targets.push_back(i - 1);
    if (i + 1 < n) graph.targets.push_back(i + 1);
    graph.first.push_back(static_cast<std::uint32_t>(graph.targets.size()));
  }
  return graph;
}

TEST(FractureGraph, JoinsTrianglesThatShareAnEdge) {
  const FractureGraph graph = triangleGraph({{0, 1, 2}, {1, 0, 3}, {2, 4, 5}}, 6);
  ASSERT_EQ(graph.nodeCount(), 3);
  EXPECT_EQ(graph.neighbours(0).size(), 1u);
  EXPECT_EQ(graph.neighbours(0)[0], 1u);
  EXPECT_EQ(graph.neighbours(1)[0], 0u);
  EXPECT_TRUE(graph.neighbours(2).empty()) << "one shared vertex is not enough";
}

TEST(FractureGraph, HasEachEdgeOnceFromBothSides) {
  const FractureGraph graph = triangleGraph(sphereMesh(1, 12, false));
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t node = 0; node < static_cast<std::uint32_t>(graph.nodeCount()); ++node)
    for (const std::uint32_t next : graph.neighbours(node)) EXPECT_TRUE(edges.insert({node, next}).second);
  EXPECT_EQ(edges.size(), static_cast<std::size_t>(3 * graph.nodeCount()));
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  EXPECT_EQ(triangleGraph({{0, 1, 2}, {0, 2, 1}}, 3).targets.size(), 2u)
      << "two faces of one triangle share three edges";
}

TEST(BreadthFirst, GivesExactlyTheAskedNumberOfConnectedPieces) {
  for (const Triangulation& method : {Triangulation{Trisection{}}, Triangulation{Delaunay{}}})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const FractureGraph graph = paneGraph(100, method, seed);
      for (int pieces = 1; pieces <= 40; ++pieces) expectValid(graph, partitionBreadthFirst(graph, pieces), pieces);
      expectValid(graph, partitionBreadthFirst(graph, graph.nodeCount()), graph.nodeCount());
    }
}

TEST(BreadthFirst, CutsAClosedSurfaceToo) {
  const FractureGraph graph = triangleGraph(sphereMesh(1, 40, false));
  for (const int pieces : {1, 2, 3, 7, 100}) expectValid(graph, partitionBreadthFirst(graph, pieces), pieces);
}

TEST(BreadthFirst, KeepsPiecesOfASheetEven) {
  const FractureGraph graph = paneGraph(2000, Delaunay{}, 1);
  const std::vector<int> of16 = sizes(partitionBreadthFirst(graph, 16));
  const double mean = graph.nodeCount() / 16.0;
  // A cut halves but for the islands handed back; four cuts in a row kept within 0.6 to 1.6 of the mean on many sheets.
  EXPECT_GT(*std::min_element(of16.begin(), of16.end()), 0.5 * mean);
  EXPECT_LT(*std::max_element(of16.begin(), of16.end()), 1.7 * mean);
  const Partition many = partitionBreadthFirst(graph, 512);
  expectValid(graph, many, 512);
  const std::vector<int> of512 = sizes(many);
  EXPECT_LE(*std::max_element(of512.begin(), of512.end()), 2 * graph.nodeCount() / 512 + 2);
}

TEST(BreadthFirst, HalvesAChainInTheMiddle) {
  const Partition partition = partitionBreadthFirst(chain(10), 2);
  EXPECT_EQ(partition.pieceOf, (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
}

TEST(BreadthFirst, HandsIslandsBack) {
  // A star of four arms, the first of length two: halves in breadth-first order would leave single arms behind.
  FractureGraph star;
  star.first = {0, 4, 6, 7, 8, 9, 10};
  star.targets = {1, 2, 3, 4, 0, 5, 0, 0, 0, 1};
  for (int pieces = 1; pieces <= 6; ++pieces) expectValid(star, partitionBreadthFirst(star, pieces), pieces);
}

TEST(BreadthFirst, KeepsPartsThatNothingJoins) {
  FractureGraph islandsOnly;
  islandsOnly.first = {0, 0, 0, 0};
  for (int pieces = 1; pieces <= 3; ++pieces) expectValid(islandsOnly, partitionBreadthFirst(islandsOnly, pieces), 3);
}

TEST(BreadthFirst, RefusesMorePiecesThanNodes) {
  EXPECT_THROW(partitionBreadthFirst(chain(4), 5), InputError);
  try {
    partitionBreadthFirst(chain(4), 5);
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "fracture: pieces: must be at most the number of triangles, 4, got 5");
  }
}

TEST(BreadthFirst, IsTheSameEveryTimeAndNumbersPiecesByTheirLowestNode) {
  const FractureGraph graph = paneGraph(300, Trisection{}, 2);
  const Partition partition = partitionBreadthFirst(graph, 33);
  EXPECT_EQ(partition.pieceOf, partitionBreadthFirst(graph, 33).pieceOf);
  int next = 0;
  for (const int piece : partition.pieceOf) {
    EXPECT_LE(piece, next);
    next = std::max(next, piece + 1);
  }
}

TEST(BreadthFirst, ARelabelledMeshIsCutIntoConnectedPiecesAsWell) {
  FlatMesh flat = triangulate(panePoints(1, 1, 200, 30, 6), Delaunay{}, 6);
  const Random random(6, Stream::test);
  for (std::size_t i = flat.triangles.size(); i > 1; --i)
    std::swap(flat.triangles[i - 1], flat.triangles[random.below(i, i)]);
  const FractureGraph graph = triangleGraph(flat.triangles, flat.points.size());
  for (const int pieces : {2, 16, 50}) expectValid(graph, partitionBreadthFirst(graph, pieces), pieces);
}

}  // namespace
}  // namespace brisance
