#include "fracture/spectral.h"

#include <gtest/gtest.h>

#include <set>

#include <fstream>
#include <set>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "fracture/spectral_samples.h"
#include "mesh/mesh_file.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

constexpr Curvature raw{CurvatureWeights::raw}, clipped{CurvatureWeights::clipped};

void expectPieces(const TriangleMesh& mesh, const Partition& partition, int pieces) {
  ASSERT_EQ(partition.pieceOf.size(), mesh.triangles.size());
  EXPECT_EQ(partition.count, pieces);
  for (const int size : pieceSizes(partition)) EXPECT_GT(size, 0);
  EXPECT_EQ(islands(triangleGraph(mesh), partition), pieces);
}

Vec3d middleOf(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
}

TriangleMesh inTwoParts(const TriangleMesh& one, const Vec3d& apart) {
  TriangleMesh mesh = one, other = one;
  recenter(other, apart);
  const auto offset = static_cast<std::uint32_t>(one.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

TEST(Spectral, CatchesTheEmptyPartOfTheThesisExample) {
  // Four entries of the vector are 0, and every triangle has two of those corners: all eight fall on one side.
  const SpectralPartition cut = partitionSurface(thesisExample(), raw, 2);
  expectPieces(thesisExample(), cut.partition, 2);
  // The median puts the triangles of one apex on each side.
  for (int t = 0; t < 4; ++t) EXPECT_EQ(cut.partition.pieceOf[t], 0);
  for (int t = 4; t < 8; ++t) EXPECT_EQ(cut.partition.pieceOf[t], 1);
  EXPECT_NEAR(cut.eigenvalues.at(1), 1.3969, 5e-5);
}

TEST(Spectral, BreaksAFoldedSheetAlongItsFold) {
  constexpr int cells = 24;
  const TriangleMesh sheet = samples::foldedSheet(cells, 90);
  const auto rowOf = [&](std::size_t t) {
    return (*std::min_element(sheet.triangles[t].begin(), sheet.triangles[t].end())) / (cells + 1);
  };
  for (const Curvature& weights : {raw, clipped}) {
    const SpectralPartition cut = partitionSurface(sheet, weights, 2);
    expectPieces(sheet, cut.partition, 2);
    // The fold covers a tenth of the length about 0.35 of it.
    std::uint32_t lastOfFirst = 0, firstOfSecond = 2 * cells;
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
      if (cut.partition.pieceOf[t] == 0)
        lastOfFirst = std::max(lastOfFirst, rowOf(t));
      else
        firstOfSecond = std::min(firstOfSecond, rowOf(t));
    EXPECT_GE(firstOfSecond, 0.30 * 2 * cells - 1);
    EXPECT_LE(lastOfFirst, 0.40 * 2 * cells);
  }
  // Weights that know nothing of the fold cut the sheet in halves.
  const std::vector<int> halves = pieceSizes(partitionSurface(sheet, Spectral{}, 2).partition);
  EXPECT_NEAR(halves[0], halves[1], 0.02 * static_cast<double>(sheet.triangles.size()));
}

TEST(Spectral, BreaksADumbbellAtItsNeck) {
  const TriangleMesh mesh = samples::dumbbell(10000);
  for (const SpectralPartition& cut :
       {partitionSurface(mesh, raw, 2), partitionSurface(mesh, clipped, 2), partitionSurface(mesh, Spectral{}, 2)}) {
    expectPieces(mesh, cut.partition, 2);
    // The balls end at x = -0.2 and x = 0.4; the neck is between.
    const int left = cut.partition.pieceOf[0];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double x = middleOf(mesh, t).x;
      if (x < -0.35) {
        EXPECT_EQ(cut.partition.pieceOf[t] == left, middleOf(mesh, 0).x < 0);
      }
      if (x > 0.55) {
        EXPECT_EQ(cut.partition.pieceOf[t] == left, middleOf(mesh, 0).x > 0);
      }
    }
  }
}

TEST(Spectral, HalvesASphereOfUnitWeights) {
  const TriangleMesh mesh = samples::bumpySphere(8000);
  for (const EdgeWeights weights : {EdgeWeights::unit, EdgeWeights::length}) {
    const SpectralPartition cut = partitionSurface(mesh, Spectral{weights}, 2);
    expectPieces(mesh, cut.partition, 2);
    for (const int size : pieceSizes(cut.partition)) EXPECT_NEAR(size, 4000, 0.06 * 4000);
  }
}

TEST(Spectral, GivesExactlyTheAskedNumberOfConnectedPieces) {
  for (const TriangleMesh& mesh : {samples::bumpySphere(1500), samples::foldedSheet(16, 90), samples::torus(1200),
                                   boxMesh({1, 2, 3}, false), thesisExample()})
    for (const int pieces : {1, 2, 3, 5, 8, 12, 64, 300}) {
      if (pieces > static_cast<int>(mesh.triangles.size())) continue;
      expectPieces(mesh, partitionSurface(mesh, raw, pieces).partition, pieces);
      expectPieces(mesh, partitionSurface(mesh, clipped, pieces).partition, pieces);
      expectPieces(mesh, partitionSurface(mesh, Spectral{}, pieces).partition, pieces);
    }
}

TEST(Spectral, CutsDownToSingleTriangles) {
  const TriangleMesh mesh = samples::bumpySphere(80);
  expectPieces(mesh, partitionSurface(mesh, raw, 80).partition, 80);
  EXPECT_THROW(partitionSurface(mesh, raw, 81), InputError);
}

TEST(Spectral, KeepsPartsThatNothingJoins) {
  const TriangleMesh mesh = inTwoParts(samples::bumpySphere(320), {3, 0, 0});
  EXPECT_EQ(partitionSurface(mesh, raw, 1).partition.count, 2);
  EXPECT_EQ(partitionSurface(mesh, raw, 1).eigenvalues, (std::vector<double>{0, 0}));
  const SpectralPartition cut = partitionSurface(mesh, raw, 5);
  expectPieces(mesh, cut.partition, 5);
  ASSERT_EQ(cut.eigenvalues.size(), 3u);
  EXPECT_EQ(cut.eigenvalues[1], 0) << "0 once for each part";
  EXPECT_GT(cut.eigenvalues[2], 0);
}

TEST(Spectral, CutsTheWeakestPartFirst) {
  // Four balls in a row, the middle joint the thinnest: after it the others, and every ball is whole at four pieces.
  const samples::Implicit row = [](const Vec3d& p) {
    double inside = 1e9;
    for (int ball = 0; ball < 4; ++ball) inside = std::min(inside, length(p - Vec3d(1.9 * ball, 0, 0)) - 1);
    return inside;
  };
  const TriangleMesh mesh = samples::surfaceNetOf(row, {{-1.2, -1.2, -1.2}, {6.9, 1.2, 1.2}}, 6000);
  const Partition cut = partitionSurface(mesh, Spectral{}, 4).partition;
  expectPieces(mesh, cut, 4);
  std::array<int, 4> pieceOfBall{-1, -1, -1, -1};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double ball = middleOf(mesh, t).x / 1.9;
    const int number = static_cast<int>(std::lround(ball));
    if (std::abs(ball - number) > 0.4) continue;  // in a joint
    if (pieceOfBall[number] < 0) pieceOfBall[number] = cut.pieceOf[t];
    EXPECT_EQ(cut.pieceOf[t], pieceOfBall[number]);
  }
}

TEST(Spectral, BreaksInsidePartsBreadthFirstWhenAsked) {
  const TriangleMesh mesh = samples::dumbbell(4000);
  const Partition halves = partitionSurface(mesh, clipped, 2).partition;
  Curvature settings = clipped;
  settings.parts = 2;
  const Partition all = partitionSurface(mesh, settings, 20).partition;
  expectPieces(mesh, all, 20);
  settings.inside = InsideParts::smallest;
  const Partition smallest = partitionSurface(mesh, settings, 20).partition;
  expectPieces(mesh, smallest, 20);
  const std::vector<int> sizes = pieceSizes(halves);
  const int small = sizes[0] < sizes[1] ? 0 : 1;
  std::vector<int> halfOfPiece(20, -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int& half = halfOfPiece[all.pieceOf[t]];
    if (half < 0) half = halves.pieceOf[t];
    EXPECT_EQ(half, halves.pieceOf[t]) << "no piece crosses the first cut";
  }
  EXPECT_EQ(*std::max_element(sizes.begin(), sizes.end()), pieceSizes(smallest)[halves.pieceOf[0] == small ? 1 : 0]);
  settings.inside = InsideParts::largest;
  const Partition largest = partitionSurface(mesh, settings, 20).partition;
  expectPieces(mesh, largest, 20);
  std::set<int> ofSmall, ofLarge;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    (halves.pieceOf[t] == small ? ofSmall : ofLarge).insert(largest.pieceOf[t]);
  EXPECT_EQ(ofSmall.size(), 1u);
  EXPECT_EQ(ofLarge.size(), 19u);
  settings.parts = 3;
  EXPECT_EQ(partitionSurface(mesh, settings, 3).partition.pieceOf,
            partitionSurface(mesh, clipped, 3).partition.pieceOf);
  EXPECT_THROW(partitionSurface(mesh, settings, 3900), InputError);
}

TEST(Spectral, IsTheSameForAnyNumberOfThreads) {
  for (const TriangleMesh& mesh : {cubeSphere(10), samples::torus(3000), samples::dumbbell(20000)}) {
    Partition one, two;
    {
      const ThreadLimit limit(1);
      one = partitionSurface(mesh, clipped, 24).partition;
    }
    {
      const ThreadLimit limit(2);
      two = partitionSurface(mesh, clipped, 24).partition;
    }
    EXPECT_EQ(one.pieceOf, two.pieceOf);
  }
}

TEST(Spectral, CutsTheNodesOfAnyGraph) {
  FractureGraph chain;
  constexpr std::uint32_t n = 300;
  chain.first.push_back(0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto weight = [](std::uint32_t left) { return left == 99 ? 0.001 : 1.0; };
    if (i > 0) chain.targets.push_back(i - 1), chain.weights.push_back(weight(i - 1));
    if (i + 1 < n) chain.targets.push_back(i + 1), chain.weights.push_back(weight(i));
    chain.first.push_back(static_cast<std::uint32_t>(chain.targets.size()));
  }
  const Partition cut = partitionSpectral(chain, 2);
  for (std::uint32_t i = 0; i < n; ++i) EXPECT_EQ(cut.pieceOf[i], i > 99) << "at the weak link";
  for (const int pieces : {1, 3, 10, 300}) {
    const Partition partition = partitionSpectral(chain, pieces);
    EXPECT_EQ(partition.count, pieces);
    EXPECT_EQ(islands(chain, partition), pieces);
  }
  EXPECT_THROW(partitionSpectral(chain, 301), InputError);
}

/// Share of triangles that are in the smaller part by both.
double agreement(const Partition& partition, const std::filesystem::path& golden) {
  const std::vector<int> sizes = pieceSizes(partition);
  const int small = sizes[0] < sizes[1] ? 0 : 1;
  std::ifstream file(golden);
  std::size_t same = 0;
  int expected = 0;
  for (const int piece : partition.pieceOf) {
    file >> expected;
    same += (piece == small) == (expected == 1);
  }
  return static_cast<double>(same) / static_cast<double>(partition.pieceOf.size());
}

struct ThesisModel {
  std::string name;
  double lambda2, lambda3, digit;
  int smallerRaw, smallerClipped;
};

TEST(Spectral, BreaksTheThesisModelsWhereTheThesisDoes) {
  const auto folder = thesisMeshes();
  if (!folder) GTEST_SKIP() << "the models of the thesis are not here (BRISANCE_MESHES names their folder)";
  for (const ThesisModel& model : {ThesisModel{"cow", 0.0039303, 0.0045814, 1e-7, 1760, 1804},
                                   ThesisModel{"teddy", 0.902985, 1.10272, 1e-5, 732, 766}}) {
    const TriangleMesh mesh = readObj(*folder / (model.name + ".obj"));
    const SpectralPartition rough = partitionSurface(mesh, raw, 2);
    expectPieces(mesh, rough.partition, 2);
    EXPECT_NEAR(rough.eigenvalues.at(1), model.lambda2, model.digit / 2);
    EXPECT_NEAR(rough.eigenvalues.at(2), model.lambda3, model.digit / 2);
    const auto smaller = [](const Partition& p) { return std::min(pieceSizes(p)[0], pieceSizes(p)[1]); };
    EXPECT_EQ(smaller(rough.partition), model.smallerRaw);
    const std::filesystem::path golden = *folder / ("golden_" + model.name + ".txt");
    EXPECT_GE(agreement(rough.partition, golden), 0.99);
    const SpectralPartition mild = partitionSurface(mesh, clipped, 2);
    expectPieces(mesh, mild.partition, 2);
    EXPECT_EQ(smaller(mild.partition), model.smallerClipped);
    EXPECT_GE(agreement(mild.partition, golden), 0.98) << "the same place";
  }
}

}  // namespace
}  // namespace brisance
