#include "fracture/curvature.h"

#include <gtest/gtest.h>

#include "assets/sample_meshes.h"
#include "fracture/spectral_samples.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

constexpr Curvature raw{CurvatureWeights::raw};

TEST(VertexStrength, OfTheThesisExampleIsWhatItsFormulaGives) {
  const std::vector<double> k = vertexStrength(thesisExample(), CurvatureWeights::raw);
  // Apexes are vertices 2 and 5.
  for (const int v : {0, 1, 3, 4}) EXPECT_NEAR(k[v], 0.4431, 5e-5);
  for (const int v : {2, 5}) EXPECT_NEAR(k[v], 0.2554, 5e-5);
}

TEST(VertexStrength, OfASphereIsTheSquareOfItsRadius) {
  // The reciprocal of the Gaussian curvature 1 / r2. Per vertex a mesh only approaches that; in the sum the deficits
  // are 4 pi by Gauss and Bonnet, so the mean of 1 / K over areas is exact.
  TriangleMesh mesh = samples::bumpySphere(2000);
  for (Vec3d& v : mesh.vertices) v = normalized(v) * 3.0;
  const std::vector<double> strength = vertexStrength(mesh, CurvatureWeights::raw);
  double mean = 0;
  for (const double k : strength) mean += k / static_cast<double>(strength.size());
  EXPECT_NEAR(mean, 9, 0.2);
}

TEST(VertexStrength, OfAFlatSheetIsFiniteInsideAndAtTheBorder) {
  TriangleMesh sheet = samples::foldedSheet(8, 0);
  const std::vector<double> strength = vertexStrength(sheet, CurvatureWeights::raw);
  const double cell = 1.0 / 8;
  // Six triangles of half a cell around an inner vertex; the straight border is as flat: deficit pi - pi.
  EXPECT_NEAR(strength[3 * 9 + 4], 3 * cell * cell / (3 * 1e-4), 1e-6);
  EXPECT_NEAR(strength[3 * 9], 1.5 * cell * cell / (3 * 1e-4), 1e-6);
  // A corner turns by a right angle: pi - pi / 2.
  EXPECT_NEAR(strength[8], cell * cell / 2 / (3 * pi / 2), 1e-9);
}

TEST(VertexStrength, ClippedStaysBetweenItsPercentiles) {
  const TriangleMesh mesh = samples::bumpySphere(5000);
  std::vector<double> rough = vertexStrength(mesh, CurvatureWeights::raw);
  const std::vector<double> clipped = vertexStrength(mesh, CurvatureWeights::clipped);
  const auto [least, most] = std::minmax_element(clipped.begin(), clipped.end());
  std::size_t below = 0, above = 0;
  for (std::size_t v = 0; v < rough.size(); ++v) {
    below += rough[v] < *least;
    above += rough[v] > *most;
    EXPECT_EQ(clipped[v], std::clamp(rough[v], *least, *most));
  }
  const double twentieth = static_cast<double>(rough.size()) / 20;
  EXPECT_NEAR(static_cast<double>(below), twentieth, 1);
  EXPECT_NEAR(static_cast<double>(above), twentieth, 1);
}

TEST(VertexStrength, SurvivesTrianglesWithoutArea) {
  TriangleMesh mesh = thesisExample();
  mesh.vertices.push_back({5, 5, 5});
  mesh.vertices.push_back({9, 9, 9});  // used by nothing
  mesh.triangles.push_back({6, 6, 6});
  for (const double k : vertexStrength(mesh, CurvatureWeights::raw)) EXPECT_GT(k, 0);
  EXPECT_EQ(vertexGraph(mesh, raw).graph.nodeCount(), 7);
}

TEST(VertexGraph, OfTheThesisExampleIsItsExactMatrix) {
  const FractureGraph graph = vertexGraph(thesisExample(), raw).graph;
  const std::vector<std::vector<double>> l = laplacian(graph);
  // Edges of the base square 0 1 3 4, and from it to the apexes 2 and 5; no diagonals.
  const double base = 0.4431, slope = 0.3492, digits = 5e-5;
  for (const auto& [a, b] : {std::pair(0, 1), {1, 3}, {3, 4}, {4, 0}}) EXPECT_NEAR(l[a][b], -base, digits);
  for (const int v : {0, 1, 3, 4})
    for (const int apex : {2, 5}) EXPECT_NEAR(l[v][apex], -slope, digits);
  for (const auto& [a, b] : {std::pair(0, 3), {1, 4}, {2, 5}}) EXPECT_EQ(l[a][b], 0);
}

TEST(VertexGraph, HasEachEdgeOnceFromBothSidesWithOneWeight) {
  const TriangleMesh sheet = samples::foldedSheet(6, 90);
  for (const FractureGraph& graph : {vertexGraph(sheet, raw).graph, vertexGraph(sheet, Spectral{}).graph,
                                     vertexGraph(sheet, Spectral{EdgeWeights::length}).graph}) {
    const std::vector<std::vector<double>> l = laplacian(graph);
    std::size_t entries = 0;
    for (std::size_t i = 0; i < l.size(); ++i)
      for (std::size_t j = 0; j < l.size(); ++j) {
        EXPECT_EQ(l[i][j], l[j][i]);
        entries += i != j && l[i][j] != 0;
      }
    EXPECT_EQ(entries, graph.targets.size());
    // Euler: V - E + F = 1 for a sheet.
    EXPECT_EQ(sheet.vertices.size() + sheet.triangles.size() - 1, graph.targets.size() / 2);
  }
}

TEST(VertexGraph, OfAPartKeepsTheWeightsOfTheWhole) {
  const TriangleMesh mesh = samples::torus(400);
  VertexGraphs graphs(mesh, raw);
  const VertexGraph whole = graphs.whole();
  std::vector<std::uint32_t> half(mesh.triangles.size() / 2);
  for (std::uint32_t t = 0; t < half.size(); ++t) half[t] = t;
  const VertexGraph part = graphs.of(half);
  EXPECT_LT(part.graph.nodeCount(), whole.graph.nodeCount());
  const std::vector<std::vector<double>> all = laplacian(whole.graph), some = laplacian(part.graph);
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t j = 0; j < some.size(); ++j)
      if (i != j && some[i][j] != 0) {
        EXPECT_EQ(some[i][j], all[part.vertexOf[i]][part.vertexOf[j]]);
      }
  for (std::uint32_t t = 0; t < half.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(part.vertexOf[part.triangles[t][corner]], mesh.triangles[t][corner]);
}

}  // namespace
}  // namespace brisance
