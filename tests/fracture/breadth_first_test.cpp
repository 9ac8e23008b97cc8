#include "fracture/breadth_first.h"

#include <gtest/gtest.h>

#include <set>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fracture/partition_facts.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"
#include "mesh/triangulation.h"

namespace brisance {
namespace {

FractureGraph paneGraph(int points, const Triangulation& method, std::uint64_t seed) {
  const FlatMesh flat = triangulate(panePoints(1, 1, points, points / 10, seed), method, seed);
  return triangleGraph(flat.triangles, flat.points.size());
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

TEST(BreadthFirst, KeepsPiecesOfASheetAsEvenAsMeasured) {
  // Sheets of 2000 points, halved largest first: sizes were 158-215 / 250 / 276-388 (least, median, largest) at 16
  // pieces, and 2-3 / 8 / 12 at 512. Pieces by what the sides hold are far more even at 16 (246-258 / 263 / 267-279
  // measured) but at 512, where a side of three pieces is a dozen triangles, the largest are 14-16.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FractureGraph graph = paneGraph(2000, Delaunay{}, seed);
    for (const auto& [pieces, least, largest] : {std::tuple(16, 0.9, 1.1), {512, 2 / 8.2, 2.0}}) {
      const Partition partition = partitionBreadthFirst(graph, pieces);
      expectValid(graph, partition, pieces);
      std::vector<int> size = sizes(partition);
      std::sort(size.begin(), size.end());
      const double mean = static_cast<double>(graph.nodeCount()) / pieces;
      EXPECT_GE(size.front(), std::floor(least * mean)) << pieces;
      EXPECT_LE(size.back(), std::ceil(largest * mean)) << pieces;
      EXPECT_NEAR(size[size.size() / 2], mean, 0.1 * mean) << pieces;
    }
  }
}

TEST(BreadthFirst, MakesPiecesAlikeForNumbersThatAreNoPowerOfTwo) {
  const FractureGraph graph = triangleGraph(samples::bumpySphere(20'000));
  for (const int pieces : {3, 5, 6, 7, 11, 24}) {
    const Partition partition = partitionBreadthFirst(graph, pieces);
    expectValid(graph, partition, pieces);
    // Halving the largest would leave the largest at 1.5 times the mean for three pieces.
    EXPECT_LT(imbalance(graph, partition), 1.3) << pieces;
  }
}

TEST(BreadthFirst, IsTheSameForAnyNumberOfThreads) {
  const FractureGraph graph = triangleGraph(samples::bumpySphere(50'000));
  const Partition many = partitionBreadthFirst(graph, 300);
  const ThreadLimit one(1);
  EXPECT_EQ(partitionBreadthFirst(graph, 300).pieceOf, many.pieceOf);
}

TEST(BreadthFirst, DividesSizesNotNodes) {
  FractureGraph graph = chain(12);
  graph.sizes = {6, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  const Partition partition = partitionBreadthFirst(graph, 3);
  EXPECT_EQ(partition.count, 3);
  EXPECT_EQ(std::count(partition.pieceOf.begin(), partition.pieceOf.end(), partition.pieceOf[0]), 1);
}

TEST(BreadthFirst, GivesPartsThatNothingJoinsPiecesBySize) {
  const FractureGraph graph = beside(chain(30), chain(10));
  const Partition partition = partitionBreadthFirst(graph, 4);
  expectValid(graph, partition, 4);
  EXPECT_EQ(sizes(partition), (std::vector<int>{10, 10, 10, 10}));
  expectValid(graph, partitionBreadthFirst(graph, 40), 40);
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
