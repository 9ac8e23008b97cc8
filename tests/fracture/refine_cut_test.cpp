#include "fracture/refine_cut.h"

#include "assets/sample_meshes.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fracture/breadth_first.h"
#include "fracture/minimum_share.h"
#include "fracture/partition_facts.h"

namespace brisance {
namespace {

TEST(RefineCut, ShortensTheCutAndKeepsPiecesConnectedAndEven) {
  for (const TriangleMesh& mesh :
       {samples::bumpySphere(20'000), samples::torus(20'000), samples::foldedSheet(70, 90)}) {
    const FractureGraph graph = triangleGraph(mesh);
    for (const int pieces : {2, 3, 16, 100, 512}) {
      const Partition start = partitionBreadthFirst(graph, pieces), refined = refineCut(graph, start);
      expectValid(graph, refined, pieces);
      EXPECT_LE(cutWeight(graph, refined), cutWeight(graph, start)) << pieces;
      EXPECT_LE(imbalance(graph, refined), 1.10) << pieces;
      if (pieces >= 16) {
        EXPECT_LT(cutWeight(graph, refined), 0.85 * cutWeight(graph, start)) << pieces;
      }
    }
  }
}

TEST(RefineCut, FindsTheShortestCutOfALattice) {
  // 40 x 20 nodes in halves: no cut is shorter than straight across, 20 edges; breadth-first from a corner cuts aslant.
  const FractureGraph graph = lattice(40, 20);
  const Partition refined = refineCut(graph, partitionBreadthFirst(graph, 2));
  expectValid(graph, refined, 2);
  EXPECT_LE(cutWeight(graph, refined), 24);  // a step or two in the line may stay
}

TEST(RefineCut, UntanglesCombs) {
  const FractureGraph graph = lattice(40, 20);
  Partition combs{std::vector<int>(800), 2};
  for (int node = 0; node < 800; ++node) {
    const int x = node % 40, y = node / 40;
    combs.pieceOf[node] = y % 2 == 0 ? x >= 1 : x >= 39;
  }
  expectValid(graph, combs, 2);
  ASSERT_GT(cutWeight(graph, combs), 700);
  const Partition refined = refineCut(graph, combs);
  expectValid(graph, refined, 2);
  EXPECT_LE(cutWeight(graph, refined), 60);  // three times the shortest
}

TEST(RefineCut, FollowsWeakEdges) {
  // A lattice that is weak between the columns 18 and 19, and halves that meet between 19 and 20: to get there the
  // first move makes the cut longer, and sizes allow 19 / 20 and 21 / 20 of half.
  FractureGraph graph = lattice(40, 12);
  Partition halves{std::vector<int>(480), 2};
  for (std::uint32_t node = 0; node < 480; ++node) {
    halves.pieceOf[node] = node % 40 >= 20;
    for (const std::uint32_t next : graph.neighbours(node)) {
      const bool weak = std::min(node % 40, next % 40) == 18 && std::max(node % 40, next % 40) == 19;
      graph.weights.push_back(weak ? 0.01 : 1.0);
    }
  }
  ASSERT_NEAR(cutWeight(graph, halves), 12, 1e-12);
  EXPECT_NEAR(cutWeight(graph, refineCut(graph, halves)), 0.12, 1e-9);
}

TEST(RefineCut, CanKeepTheSizesOfPieces) {
  const FractureGraph graph = lattice(60, 20);
  Partition uneven{std::vector<int>(1200), 2};
  for (int node = 0; node < 1200; ++node) uneven.pieceOf[node] = node % 60 >= 12 + (node / 60) % 4;
  const std::vector<int> before = sizes(uneven);
  const Partition refined = refineCut(graph, uneven, Balance::keep);
  expectValid(graph, refined, 2);
  const std::vector<int> after = sizes(refined);
  for (int piece = 0; piece < 2; ++piece) EXPECT_NEAR(after[piece], before[piece], 0.2 * before[piece]);
  EXPECT_LT(cutWeight(graph, refined), cutWeight(graph, uneven));
}

TEST(RefineCut, EvensOutWhatStartsUneven) {
  const FractureGraph graph = lattice(60, 60);
  Partition uneven{std::vector<int>(3600), 4};
  for (int node = 0; node < 3600; ++node) {
    const int x = node % 60;
    uneven.pieceOf[node] = (x >= 5) + (x >= 11) + (x >= 20);
  }
  const Partition refined = refineCut(graph, uneven);
  expectValid(graph, refined, 4);
  EXPECT_LE(imbalance(graph, refined), 1.10);
}

TEST(RefineCut, LooksAtSizesOfNodes) {
  FractureGraph graph = lattice(30, 30);
  const Random random(1, Stream::test);
  for (std::uint32_t node = 0; node < 900; ++node) graph.sizes.push_back(1e-6 * (0.5 + random.uniform(node)));
  const Partition refined = refineCut(graph, partitionBreadthFirst(graph, 9));
  expectValid(graph, refined, 9);
  EXPECT_LE(imbalance(graph, refined), 1.10);
}

TEST(RefineCut, IsTheSameForAnyNumberOfThreads) {
  const FractureGraph graph = triangleGraph(samples::bumpySphere(100'000));
  const Partition start = partitionBreadthFirst(graph, 60), many = refineCut(graph, start);
  const ThreadLimit one(1);
  EXPECT_EQ(refineCut(graph, start).pieceOf, many.pieceOf);
}

TEST(RefineCut, LeavesWhatCannotBeBetter) {
  const FractureGraph path = chain(10);
  for (const int pieces : {1, 2, 5, 10})
    expectValid(path, refineCut(path, partitionBreadthFirst(path, pieces)), pieces);
  const FractureGraph apart = beside(chain(5), chain(5));
  expectValid(apart, refineCut(apart, partitionBreadthFirst(apart, 2)), 2);
}

double smallestShare(const FractureGraph& graph, const Partition& partition) {
  const std::vector<int> size = sizes(partition);
  return *std::min_element(size.begin(), size.end()) * static_cast<double>(partition.count) / graph.nodeCount();
}

TEST(MinimumShare, LeavesNoPieceTooSmall) {
  const FractureGraph graph = lattice(40, 40);
  Partition crumbs{std::vector<int>(1600), 11};
  for (int node = 0; node < 10; ++node) crumbs.pieceOf[node] = node + 1;
  ASSERT_LT(smallestShare(graph, crumbs), 0.01);
  const Partition mended = enforceMinimumShare(graph, crumbs, 0.5);
  expectValid(graph, mended, 11);
  EXPECT_GE(smallestShare(graph, mended), 0.5);
}

TEST(MinimumShare, ChangesNothingWhereNothingIsSmall) {
  const FractureGraph graph = lattice(40, 40);
  const Partition even = partitionBreadthFirst(graph, 8);
  EXPECT_EQ(enforceMinimumShare(graph, even, 0.5).pieceOf, even.pieceOf);
}

TEST(MinimumShare, KeepsWhatNothingHolds) {
  const FractureGraph apart = beside(chain(20), chain(1));
  const Partition partition = partitionBreadthFirst(apart, 4);
  const Partition mended = enforceMinimumShare(apart, partition, 0.9);
  expectValid(apart, mended, 4);
}

TEST(MinimumShare, EndsWhereNothingCanImprove) {
  // A star's arms can only be cut off one by one.
  FractureGraph star;
  star.first.push_back(0);
  for (std::uint32_t arm = 1; arm <= 9; ++arm) star.targets.push_back(arm);
  star.first.push_back(9);
  for (std::uint32_t arm = 1; arm <= 9; ++arm) {
    star.targets.push_back(0);
    star.first.push_back(9 + arm);
  }
  expectValid(star, enforceMinimumShare(star, partitionBreadthFirst(star, 4), 1), 4);
}

}  // namespace
}  // namespace brisance
