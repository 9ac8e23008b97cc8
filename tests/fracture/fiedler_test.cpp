#include "fracture/fiedler.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assets/sample_meshes.h"
#include "base/parallel.h"
#include "fracture/curvature.h"
#include "fracture/lobpcg.h"
#include "fracture/multigrid_cycle.h"
#include "fracture/spectral_samples.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

Eigen::MatrixXd matrixOf(const FractureGraph& graph) {
  const std::vector<std::vector<double>> l = laplacian(graph);
  const auto n = static_cast<Eigen::Index>(l.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = l[i][j];
  return matrix;
}
Eigen::VectorXd eigenvaluesOf(const FractureGraph& graph) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrixOf(graph)).eigenvalues();
}

double residualOf(const FractureGraph& graph, const std::vector<double>& vector) {
  const Eigen::MatrixXd l = matrixOf(graph);
  const Eigen::Map<const Eigen::VectorXd> x(vector.data(), static_cast<Eigen::Index>(vector.size()));
  const double lambda = x.dot(l * x) / x.squaredNorm();
  return (l * x - lambda * x).norm() / (lambda * x.norm());
}

/// Closed, open, bumpy, with handles, in two parts; all weights above 0.
std::vector<FractureGraph> family() {
  TriangleMesh twoBalls = sphereMesh(1, 8, false), other = twoBalls;
  recenter(other, {3, 0, 0});
  const auto offset = static_cast<std::uint32_t>(twoBalls.vertices.size());
  twoBalls.vertices.insert(twoBalls.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) twoBalls.triangles.push_back({a + offset, b + offset, c + offset});
  std::vector<FractureGraph> graphs;
  for (const TriangleMesh& mesh : {thesisExample(), boxMesh({1, 2, 3}, false), samples::bumpySphere(300),
                                   samples::foldedSheet(6, 90), samples::torus(300), twoBalls}) {
    for (const CurvatureWeights weights : {CurvatureWeights::raw, CurvatureWeights::clipped})
      graphs.push_back(vertexGraph(mesh, Curvature{weights}).graph);
    graphs.push_back(vertexGraph(mesh, Spectral{EdgeWeights::length}).graph);
  }
  return graphs;
}

int componentsOf(const FractureGraph& graph) {
  return islands(graph, {std::vector<int>(static_cast<std::size_t>(graph.nodeCount()), 0), 1});
}

TEST(Laplacian, HasTheThesisExamplesEigenvalues) {
  const FractureGraph graph = vertexGraph(thesisExample(), Curvature{CurvatureWeights::raw}).graph;
  const Eigen::VectorXd values = eigenvaluesOf(graph);
  const std::array expected{0.0, 1.3969, 1.5847, 1.5847, 2.0954, 2.4709};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(values[i], expected[i], 5e-5);
  const FiedlerVector fiedler = fiedlerVector(graph);
  EXPECT_NEAR(fiedler.eigenvalues[1], 1.3969, 5e-5);
  EXPECT_NEAR(fiedler.eigenvalues[2], 1.5847, 5e-5);
  for (const int v : {0, 1, 3, 4}) EXPECT_NEAR(fiedler.vector[v], 0, 1e-14);
  EXPECT_NEAR(fiedler.vector[2], -fiedler.vector[5], 1e-14);
}

TEST(Laplacian, RowsAddUpToNothing) {
  for (const FractureGraph& graph : family()) {
    const Eigen::MatrixXd l = matrixOf(graph);
    EXPECT_LE(l.rowwise().sum().cwiseAbs().maxCoeff(), 1e-14 * l.diagonal().maxCoeff());
  }
}

TEST(Laplacian, IsTheIncidenceMatrixTimesItsTransposeWhateverTheSigns) {
  const Random random(1, Stream::test);
  for (const FractureGraph& graph : family()) {
    const auto n = static_cast<Eigen::Index>(graph.nodeCount()),
               edges = static_cast<Eigen::Index>(graph.targets.size() / 2);
    Eigen::MatrixXd incidence = Eigen::MatrixXd::Zero(n, edges);
    Eigen::Index e = 0;
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
        if (graph.targets[k] < i) continue;
        const double sign = random.bits(k) & 1 ? 1 : -1;
        incidence(i, e) = sign * std::sqrt(graph.weights[k]);
        incidence(graph.targets[k], e++) = -sign * std::sqrt(graph.weights[k]);
      }
    const Eigen::MatrixXd l = matrixOf(graph);
    EXPECT_LE((incidence * incidence.transpose() - l).cwiseAbs().maxCoeff(), 1e-14 * l.diagonal().maxCoeff());
  }
}

TEST(Laplacian, HasNoNegativeEigenvalueAndOneZeroPerComponent) {
  for (const FractureGraph& graph : family()) {
    const Eigen::VectorXd values = eigenvaluesOf(graph);
    const double rounding = 1e-14 * static_cast<double>(values.size()) * values.maxCoeff();
    EXPECT_GE(values.minCoeff(), -rounding);
    EXPECT_EQ((values.array() < rounding).count(), componentsOf(graph));
  }
}

TEST(Laplacian, EigenvaluesAreRayleighQuotientsOverEdges) {
  for (const FractureGraph& graph : family()) {
    if (componentsOf(graph) > 1) continue;
    const FiedlerVector fiedler = fiedlerVector(graph);
    double energy = 0, norm = 0;
    for (std::uint32_t i = 0; i < fiedler.vector.size(); ++i) {
      norm += fiedler.vector[i] * fiedler.vector[i];
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
        energy += graph.weights[k] * std::pow(fiedler.vector[i] - fiedler.vector[graph.targets[k]], 2) / 2;
    }
    // The quotient is stationary at an eigenvector: off by the square of the residual.
    EXPECT_NEAR(energy / norm, fiedler.eigenvalues[1], 1e-10 * fiedler.eigenvalues[1]);
  }
}

TEST(Fiedler, AgreesWithADenseSolutionOnEveryKindOfGraph) {
  for (const TriangleMesh& mesh : {samples::bumpySphere(900), samples::foldedSheet(14, 90), samples::torus(800)})
    for (const CurvatureWeights weights : {CurvatureWeights::raw, CurvatureWeights::clipped}) {
      const FractureGraph graph = vertexGraph(mesh, Curvature{weights}).graph;
      const Eigen::VectorXd values = eigenvaluesOf(graph);
      const FiedlerVector fiedler = fiedlerVector(graph);
      EXPECT_GT(fiedler.iterations, 0) << "the multigrid path";
      EXPECT_NEAR(fiedler.eigenvalues[1] / values[1], 1, 1e-9);
      EXPECT_NEAR(fiedler.eigenvalues[2] / values[2], 1, 1e-5);
      EXPECT_LE(fiedler.residual, 1e-6);
      EXPECT_NEAR(residualOf(graph, fiedler.vector), fiedler.residual, 1e-9);
    }
}

TEST(Fiedler, SolvesAStarWhoseNodesAllJoinOneAggregate) {
  constexpr std::uint32_t arms = 500;
  FractureGraph star;
  star.first = {0, arms};
  for (std::uint32_t i = 1; i <= arms; ++i) {
    star.targets.push_back(i);
    star.weights.push_back(1 + i % 7);
  }
  for (std::uint32_t i = 1; i <= arms; ++i) {
    star.targets.push_back(0);
    star.weights.push_back(1 + i % 7);
    star.first.push_back(arms + i);
  }
  const FiedlerVector fiedler = fiedlerVector(star);
  // Arms of weight 1 against each other, with the middle at rest: lambda_2 = 1, many times over.
  EXPECT_NEAR(fiedler.eigenvalues[1], 1, 1e-9);
}

TEST(Fiedler, IsUnmovedByTheUnitOfTheWeights) {
  FractureGraph graph = vertexGraph(samples::bumpySphere(3000), Curvature{}).graph;
  const FiedlerVector before = fiedlerVector(graph);
  for (double& weight : graph.weights) weight *= 0x1p-100;
  const FiedlerVector after = fiedlerVector(graph);
  EXPECT_EQ(after.eigenvalues[1], before.eigenvalues[1] * 0x1p-100);
  EXPECT_EQ(after.vector, before.vector);
}

TEST(Fiedler, IsTheSameForAnyNumberOfThreads) {
  const FractureGraph graph = vertexGraph(samples::dumbbell(40000), Curvature{}).graph;
  FiedlerVector one, two;
  {
    const ThreadLimit limit(1);
    one = fiedlerVector(graph);
  }
  {
    const ThreadLimit limit(2);
    two = fiedlerVector(graph);
  }
  EXPECT_EQ(one.vector, two.vector);
  EXPECT_EQ(one.eigenvalues, two.eigenvalues);
}

TEST(Fiedler, OfARingKnowsTheEigenspaceAndTakesTheSameOfIt) {
  for (const std::uint32_t n : {12u, 1000u}) {
    const FractureGraph graph = ring(n);
    const FiedlerVector fiedler = fiedlerVector(graph);
    const double lambda = 2 - 2 * portableSinCos(2 * pi / n).cos;
    EXPECT_NEAR(fiedler.eigenvalues[1] / lambda, 1, 1e-8);
    EXPECT_NEAR(fiedler.eigenvalues[2] / lambda, 1, 1e-8);
    // A sine wave around the ring, of unit length: sqrt(2 / n) at its height.
    EXPECT_NEAR(*std::max_element(fiedler.vector.begin(), fiedler.vector.end()), std::sqrt(2.0 / n),
                0.02 * std::sqrt(2.0 / n));
  }
}

/// The vectors of the first values of a graph that any start leads to.
template <int K>
BlockVector<K, double> iterateFrom(const FractureGraph& graph, std::uint64_t seed) {
  const GraphMultigrid grid(graph);
  MultigridCycle<K> cycle(grid);
  const Random random(seed, Stream::test);
  BlockVector<K, double> x(static_cast<std::size_t>(graph.nodeCount()));
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < K; ++c) x[i][c] = random.normal(i * K + c);
  const EigenProblem<double> problem{graph.first, graph.targets, graph.weights, grid.levels[0].mass};
  const typename Lobpcg<K, double>::Precondition precondition = [&](const auto& b, auto& out) {
    cycle.apply(0, b, out);
  };
  const EigenReport<K> report = Lobpcg<K, double>(problem, x, precondition).run(1e-6, 3, 200);
  EXPECT_LT(report.iterations, 200);
  return x;
}

TEST(Fiedler, OfASymmetricBallIsTheSameFromAnyStart) {
  // lambda_2 of a body with the symmetries of a cube belongs to three vectors (x, y, z in their main part).
  const TriangleMesh mesh = cubeSphere(8);
  const FractureGraph graph = vertexGraph(mesh, Spectral{}).graph;
  const Eigen::VectorXd values = eigenvaluesOf(graph);
  ASSERT_NEAR(values[3] / values[1], 1, 1e-10) << "three vectors";
  ASSERT_GT(values[4] / values[1], 1.1);
  const FiedlerVector fiedler = fiedlerVector(graph);
  for (const std::uint64_t seed : {1, 2, 3}) {
    // Whatever three vectors an iteration ends in: ours lies in their span.
    const BlockVector<4, double> space = iterateFrom<4>(graph, seed);
    std::array<double, 3> along{};
    for (std::size_t i = 0; i < space.size(); ++i)
      for (int c = 0; c < 3; ++c) along[c] += space[i][c] * fiedler.vector[i];
    const double inside = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    EXPECT_NEAR(inside, 1, 1e-9);
  }
  EXPECT_LE(residualOf(graph, fiedler.vector), 1e-6);
}

}  // namespace
}  // namespace brisance
