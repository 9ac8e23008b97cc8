#include "fracture/voronoi.h"

#include <set>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fracture/cell_seeds.h"
#include "fracture/nearest_point.h"
#include "fracture/partition_facts.h"

namespace brisance {
namespace {

FractureGraph placedGraph(const TriangleMesh& mesh) {
  FractureGraph graph = triangleGraph(mesh);
  graph.places = centroids(mesh);
  return graph;
}

std::vector<Vec3d> randomPlaces(int count) {
  const Random random(1, Stream::test);
  std::vector<Vec3d> places;
  places.reserve(count);
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i)
    places.push_back({random.uniform(3 * i), random.uniform(3 * i + 1), random.uniform(3 * i + 2)});
  return places;
}

Voronoi crowdedAt(const Vec3d& impact) { return {impact, 2}; }

TEST(PointTree, FindsTheNearestAndOfEqualsTheLowest) {
  std::vector<Vec3d> places = randomPlaces(500);
  for (int i = 0; i < 50; ++i) places.push_back(places[i]);
  std::vector<PointTree::Entry> entries;
  GrowingPoints growing;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    entries.push_back({places[i], i});
    growing.add(places[i], i);
  }
  const PointTree tree(entries);
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Vec3d from = places[i] + Vec3d(i % 3 ? 0.05 : 0, 0.01 * (i % 5), 0);
    Nearest expected, found;
    for (std::uint32_t j = 0; j < places.size(); ++j) expected.offer(dot(from - places[j], from - places[j]), j);
    tree.search(from, found);
    EXPECT_EQ(found.id, expected.id);
    EXPECT_EQ(growing.nearest(from).id, expected.id);
  }
}

TEST(CellSeeds, AreDifferentPlacesWellApart) {
  const std::vector<Vec3d> places = randomPlaces(20'000);
  const std::vector<std::uint32_t> seeds = crowdedPoints(places, {}, 100, {}, 1);
  EXPECT_EQ(std::set(seeds.begin(), seeds.end()).size(), 100u);
  double least = 1;
  for (const std::uint32_t a : seeds)
    for (const std::uint32_t b : seeds)
      if (a != b) least = std::min(least, length(places[a] - places[b]));
  // 100 points at random in a unit cube: the closest pair is about (2 / (100^2 4 pi / 3))^(1/3) = 0.04 apart; the best
  // of eight draws keeps near half of the lattice distance 0.2.
  EXPECT_GT(least, 0.06);
  EXPECT_EQ(crowdedPoints(places, {}, 100, {}, 1), seeds);
  EXPECT_NE(crowdedPoints(places, {}, 100, {}, 2), seeds);
}

TEST(CellSeeds, CanBeAllPlaces) {
  const std::vector<Vec3d> places(40, Vec3d(1, 2, 3));
  const std::vector<std::uint32_t> seeds = crowdedPoints(places, {}, 50, crowdedAt({0, 0, 0}), 1);
  EXPECT_EQ(std::set(seeds.begin(), seeds.end()).size(), 40u);
}

TEST(CellSeeds, FollowSizes) {
  std::vector<Vec3d> places = randomPlaces(4000);
  std::vector<double> sizes;
  sizes.reserve(places.size());
  for (const Vec3d& place : places) sizes.push_back(place.x < 0.5 ? 9 : 1);
  int heavy = 0;
  for (const std::uint32_t seed : crowdedPoints(places, sizes, 400, {}, 1)) heavy += places[seed].x < 0.5;
  // Draws alone would give 360; the wish for distance gives some back.
  EXPECT_GT(heavy, 240);
}

TEST(CellSeeds, DensityFallsWithDistanceByItsLaw) {
  const Voronoi cells = crowdedAt({1, 0, 0});
  EXPECT_NEAR(cellDensity(cells, {1, 0, 0}, 4), 100, 1e-10);
  EXPECT_NEAR(cellDensity(cells, {5, 0, 0}, 4), 1 / 1.21, 1e-12);
  EXPECT_EQ(cellDensity({}, {5, 0, 0}, 4), 1);
  EXPECT_EQ(cellDensity({Vec3d(1, 0, 0), 0}, {5, 0, 0}, 4), 1);
}

TEST(Voronoi, GivesExactlyTheAskedNumberOfConnectedPieces) {
  for (const TriangleMesh& mesh :
       {samples::bumpySphere(5000), samples::torus(5000), samples::dumbbell(5000), samples::foldedSheet(30, 170)}) {
    const FractureGraph graph = placedGraph(mesh);
    for (const int pieces : {1, 2, 7, 50, 400})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        expectValid(graph, partitionVoronoi(graph, pieces, {}, seed), pieces);
        expectValid(graph, partitionVoronoi(graph, pieces, crowdedAt({1, 0, 0}), seed), pieces);
      }
  }
}

TEST(Voronoi, NodesOfAFlatLatticeGoToTheNearestSeed) {
  const FractureGraph graph = lattice(60, 60);
  const Partition partition = partitionVoronoi(graph, 30, {}, 5);
  const std::vector<std::uint32_t> seeds = crowdedPoints(graph.places, {}, 30, {}, 5);
  int elsewhere = 0;
  for (std::uint32_t node = 0; node < 3600; ++node) {
    const auto near = std::min_element(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
      return length(graph.places[a] - graph.places[node]) < length(graph.places[b] - graph.places[node]);
    });
    elsewhere += partition.pieceOf[*near] != partition.pieceOf[node];
  }
  EXPECT_LT(elsewhere, 36) << "but for ties and a stray corner";
}

TEST(Voronoi, PiecesNearAnImpactAreSmaller) {
  const FractureGraph graph = lattice(200, 200);
  const Vec3d impact(100, 100, 0);
  const Partition partition = partitionVoronoi(graph, 100, crowdedAt(impact), 1);
  const std::vector<int> size = sizes(partition);
  double near = 0, far = 0;
  int nearCount = 0, farCount = 0;
  for (std::uint32_t node = 0; node < 40'000; ++node) {
    // The mean over nodes of the size of their piece.
    const double distance = length(graph.places[node] - impact);
    if (distance < 15) near += size[partition.pieceOf[node]], ++nearCount;
    if (distance > 90) far += size[partition.pieceOf[node]], ++farCount;
  }
  // The law: density 100 at the impact, about (0.1 + 15 / 141)^-2 = 23 at the inner bound, (0.1 + 90 / 141)^-2 = 1.8 at
  // the outer one.
  EXPECT_LT(near / nearCount * 5, far / farCount);
}

TEST(Voronoi, KeepsPartsThatNothingJoinsApart) {
  FractureGraph graph = beside(lattice(20, 10), lattice(10, 10));
  graph.places = lattice(20, 10).places;
  for (const Vec3d& place : lattice(10, 10).places) graph.places.push_back(place);  // both in one place
  for (const int pieces : {2, 3, 9, 30}) expectValid(graph, partitionVoronoi(graph, pieces, {}, 1), pieces);
  expectValid(graph, partitionVoronoi(graph, 1, {}, 1), 2);
  EXPECT_THROW(partitionVoronoi(graph, 301, {}, 1), InputError);
}

TEST(Voronoi, TakesNodesInOnePlace) {
  FractureGraph graph = chain(12);
  graph.places.assign(12, Vec3d(1, 1, 1));
  for (int pieces = 1; pieces <= 12; ++pieces) expectValid(graph, partitionVoronoi(graph, pieces, {}, 1), pieces);
}

TEST(Voronoi, IsTheSameForAnyNumberOfThreads) {
  const FractureGraph graph = placedGraph(samples::bumpySphere(50'000));
  const Partition many = partitionVoronoi(graph, 64, {}, 3);
  const ThreadLimit one(1);
  EXPECT_EQ(partitionVoronoi(graph, 64, {}, 3).pieceOf, many.pieceOf);
  EXPECT_NE(partitionVoronoi(graph, 64, {}, 4).pieceOf, many.pieceOf);
}

}  // namespace
}  // namespace brisance
