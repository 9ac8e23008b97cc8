#include "fracture/partition.h"

#include <gtest/gtest.h>

#include <set>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "fracture/fracture.h"
#include "mesh/mesh_topology.h"
#include "scrambled_mesh.h"

namespace brisance {
namespace {

FractureSettings way(const FractureMethod& method, int pieces) {
  FractureSettings settings;
  settings.method = method;
  settings.pieces = pieces;
  return settings;
}

/// Every method, and what may be asked of it beside.
std::vector<FractureSettings> everyWay(int pieces) {
  std::vector<FractureSettings> ways;
  ways.reserve(10);
  for (const FractureMethod& method :
       {FractureMethod(BreadthFirst{}), FractureMethod(BreadthFirstThesis{ThesisSplit::list}),
        FractureMethod(BreadthFirstThesis{ThesisSplit::level}), FractureMethod(Curvature{}),
        FractureMethod(Curvature{CurvatureWeights::raw, 2, InsideParts::smallest}),
        FractureMethod(Spectral{EdgeWeights::length}), FractureMethod(Voronoi{}),
        FractureMethod(Voronoi{Vec3d(0.5, 0.5, 0.7), 3}), FractureMethod(BreadthFirst{}),
        FractureMethod(BreadthFirst{})})
    ways.push_back(way(method, pieces));
  ways[8].refine = true;
  ways[9].minimumShare = 0.8;
  return ways;
}

std::vector<TriangleMesh> shapes() {
  return {samples::bumpySphere(2000), samples::dumbbell(3000), samples::torus(1500), samples::foldedSheet(12, 100)};
}

TEST(Partition, OfAScrambledMeshIsTheSame) {
  for (const TriangleMesh& mesh : shapes())
    for (const FractureSettings& how : everyWay(8)) {
      const std::vector<int> pieceOf = partitionSurface(mesh, how).partition.pieceOf;
      const ScrambledMesh other = scrambled(mesh, 5);
      const std::vector<int> again = partitionSurface(other.mesh, how).partition.pieceOf;
      for (std::size_t t = 0; t < again.size(); ++t)
        ASSERT_EQ(again[t], pieceOf[other.triangleOf[t]]) << fractureMethodNames[how.method.index()];
    }
}

TEST(Partition, HasExactlyTheAskedPiecesAndThemConnected) {
  for (const TriangleMesh& mesh : shapes())
    for (const FractureSettings& how : everyWay(16)) {
      const FracturedBody body = fractureMesh(mesh, how, 0.01);
      ASSERT_EQ(body.pieces.size(), 16u) << fractureMethodNames[how.method.index()];
      std::size_t triangles = 0;
      for (const Piece& piece : body.pieces) {
        triangles += piece.mesh.triangles.size();
        if (!std::holds_alternative<BreadthFirstThesis>(how.method)) {
          EXPECT_EQ(componentCount(piece.mesh), 1) << fractureMethodNames[how.method.index()];
        }
      }
      EXPECT_EQ(triangles, mesh.triangles.size());
    }
}

TEST(Partition, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = samples::bumpySphere(20000);
  for (const FractureSettings& how : everyWay(64)) {
    std::vector<std::vector<int>> results;
    for (const int threads : {1, 2, 5}) {
      const ThreadLimit limit(threads);
      results.push_back(partitionSurface(mesh, how).partition.pieceOf);
    }
    EXPECT_EQ(results[0], results[1]) << fractureMethodNames[how.method.index()];
    EXPECT_EQ(results[0], results[2]) << fractureMethodNames[how.method.index()];
  }
}

TEST(Partition, PiecesHoldAtLeastTheAskedShare) {
  FractureSettings settings;
  settings.method = Curvature{};
  settings.pieces = 12;
  settings.minimumShare = 0.4;
  const TriangleMesh mesh = samples::figurine(6000);
  const FracturedBody body = fractureMesh(mesh, settings, 0.01);
  for (const Piece& piece : body.pieces)
    EXPECT_GE(static_cast<double>(piece.mesh.triangles.size()), 0.4 * static_cast<double>(mesh.triangles.size()) / 12);
}

TEST(Partition, OfMorePiecesThanTrianglesIsRefused) {
  for (const FractureSettings& how : everyWay(64)) EXPECT_THROW(partitionSurface(samples::torus(20), how), InputError);
}

/// Centroid and volume of each piece tell pieces apart.
std::set<std::array<double, 4>> pieceFacts(const FracturedBody& body) {
  std::set<std::array<double, 4>> facts;
  for (const Piece& piece : body.pieces)
    facts.insert({piece.place.x, piece.place.y, piece.place.z, piece.properties.volume});
  return facts;
}

TEST(Partition, OfAScrambledSolidHasTheSamePieces) {
  for (const TriangleMesh& mesh : {samples::bumpySphere(2000), samples::dumbbell(3000), samples::torus(1500)})
    for (FractureSettings how : everyWay(8)) {
      if (std::holds_alternative<BreadthFirstThesis>(how.method)) continue;
      how.solid.enabled = true;
      const auto facts = pieceFacts(fractureMesh(mesh, how, 0)),
                 again = pieceFacts(fractureMesh(scrambled(mesh, 5).mesh, how, 0));
      ASSERT_EQ(facts.size(), 8u) << fractureMethodNames[how.method.index()];
      ASSERT_EQ(again.size(), 8u) << fractureMethodNames[how.method.index()];
      // Sums over faces run in the order of the mesh's lists: alike up to rounding.
      auto other = again.begin();
      for (const auto& piece : facts) {
        for (int n = 0; n < 4; ++n) EXPECT_NEAR(piece[n], (*other)[n], 1e-9) << fractureMethodNames[how.method.index()];
        ++other;
      }
    }
}

}  // namespace
}  // namespace brisance
