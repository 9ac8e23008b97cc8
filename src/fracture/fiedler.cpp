#include "fracture/fiedler.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/random.h"
#include "fracture/lobpcg.h"
#include "fracture/multigrid_cycle.h"

namespace brisance {
namespace {

constexpr int directLimit = 100;     // nodes: a dense solution takes about a millisecond
constexpr int coarseIterations = 2;  // what a start on the next finer level needs
constexpr double coarseResidual = 1e-2;
constexpr int mostIterations = 200;

/// Eigenvalues closer than this, relative, are one eigenvalue of several vectors.
double sameEigenvalue(const EigenTolerance& tolerance) { return std::min(tolerance.residual, 1e-5); }

/// Some smallest pairs above 0.
struct Eigenspace {
  std::vector<double> values;
  std::vector<std::vector<double>> vectors;
  double residual = 0;
  int iterations = 0;
  /// How many vectors belong to the first value.
  std::size_t multiplicity(double same) const {
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [&](double v) { return v - values[0] <= same * values[0]; }));
  }
};

double edgeWeight(const FractureGraph& graph, std::uint32_t k) { return graph.weights.empty() ? 1 : graph.weights[k]; }

/// |L x - lambda x| / (lambda |x|).
double relativeResidual(const FractureGraph& graph, const std::vector<double>& x, double lambda) {
  const auto sums = sumOverNodes<2>(x.size(), [&](std::uint32_t begin, std::uint32_t end, auto& out) {
    for (std::uint32_t i = begin; i < end; ++i) {
      double image = 0;
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
        image += edgeWeight(graph, k) * (x[i] - x[graph.targets[k]]);
      out[0] += (image - lambda * x[i]) * (image - lambda * x[i]);
      out[1] += x[i] * x[i];
    }
  });
  return std::sqrt(sums[0] / sums[1]) / lambda;
}

Eigenspace solveDirectly(const FractureGraph& graph) {
  const int n = graph.nodeCount();
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i)
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      laplacian(i, graph.targets[k]) -= edgeWeight(graph, k);
      laplacian(i, i) += edgeWeight(graph, k);
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(laplacian);
  Eigenspace space;
  for (int c = 1; c < n; ++c) {
    space.values.push_back(solver.eigenvalues()[c]);
    const auto column = solver.eigenvectors().col(c);
    space.vectors.emplace_back(column.begin(), column.end());
  }
  return space;
}

/// Approximate pairs, the smallest above 0, on some level.
template <int K>
struct EigenStart {
  BlockVector<K, double> x;
  std::array<double, K> values{};
};

/// Of the coarsest level that has nodes enough: its own vectors, with M-orthonormal columns.
template <int K>
EigenStart<K> coarsestVectors(const GraphLevel& level) {
  const std::uint32_t n = level.rows.size();
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(n, n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = level.rows.first[i]; k < level.rows.first[i + 1]; ++k) {
      const std::uint32_t j = level.rows.targets[k];
      const double weight = level.rows.weights[k];
      scaled(i, j) -= weight / std::sqrt(static_cast<double>(level.mass[i]) * level.mass[j]);
      scaled(i, i) += weight / level.mass[i];
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  EigenStart<K> start{BlockVector<K, double>(n), {}};
  for (int c = 0; c < K; ++c) {
    start.values[c] = solver.eigenvalues()[1 + c];
    for (std::uint32_t i = 0; i < n; ++i)
      start.x[i][c] = solver.eigenvectors()(i, 1 + c) / std::sqrt(static_cast<double>(level.mass[i]));
  }
  return start;
}

template <int K>
BlockVector<K, double> anyVectors(std::size_t nodes) {
  const Random random(0, Stream::eigenvectorStart);
  BlockVector<K, double> x(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int c = 0; c < K; ++c) x[i][c] = random.uniform(i * K + c) - 0.5;
  return x;
}

/// x = x - damping D^-1 L x
template <int K>
void jacobiSweep(const LaplacianRows& rows, double damping, BlockVector<K, double>& x,
                 BlockVector<K, double>& scratch) {
  forNodes(x.size(), [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      std::array<double, K> sum{};
      for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
        for (int c = 0; c < K; ++c) sum[c] += rows.weights[k] * (x[i][c] - x[rows.targets[k]][c]);
      for (int c = 0; c < K; ++c) scratch[i][c] = x[i][c] - damping / rows.diagonal[i] * sum[c];
    }
  });
  x.swap(scratch);
}

/// From the next level, constant on each aggregate, then smoothed: D^-1 L has eigenvalues up to 2, and the Chebyshev
/// polynomial of these dampings leaves 4 % of what is above a tenth of that, but all of a smooth vector.
template <int K>
BlockVector<K, double> prolonged(const GraphLevel& fine, const BlockVector<K, double>& coarse) {
  BlockVector<K, double> x(fine.rows.size()), scratch(fine.rows.size());
  forNodes(x.size(), [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) x[i] = coarse[fine.aggregateOf[i]];
  });
  constexpr int sweeps = 6;
  constexpr double lowest = 0.2, highest = 2;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const double root = portableSinCos(pi * (2 * sweep + 1) / (2 * sweeps)).cos;
    jacobiSweep<K>(fine.rows, 2 / (highest + lowest + (highest - lowest) * root), x, scratch);
  }
  return x;
}

/// When an iteration ends (lobpcg.h).
struct Goal {
  double residual;
  int wanted, mostIterations;
};

template <int K, class Weight>
EigenReport<K> iterate(const EigenProblem<Weight>& problem, MultigridCycle<K>& cycle, std::size_t level,
                       BlockVector<K, double>& x, const Goal& goal) {
  const typename Lobpcg<K, Weight>::Precondition precondition =
      [&](const BlockVector<K, float>& b, BlockVector<K, float>& out) { cycle.apply(level, b, out); };
  return Lobpcg<K, Weight>(problem, x, precondition).run(goal.residual, goal.wanted, goal.mostIterations);
}

/// Up from the coarsest level of more than K nodes, to be prolonged to the finest.
template <int K>
EigenStart<K> coarseStart(const GraphMultigrid& grid, double residual) {
  MultigridCycle<K> cycle(grid);
  std::size_t level = grid.levels.size() - 1;
  while (level > 0 && grid.levels[level].rows.size() <= K) --level;
  EigenStart<K> start = grid.levels[level].rows.size() <= GraphMultigrid::coarsestSize
                            ? coarsestVectors<K>(grid.levels[level])
                            : EigenStart<K>{anyVectors<K>(grid.levels[level].rows.size()), {}};
  while (level-- > 1) {
    const GraphLevel& fine = grid.levels[level];
    start.x = prolonged<K>(fine, start.x);
    const EigenProblem<float> problem{fine.rows.first, fine.rows.targets, fine.rows.weights, fine.mass};
    const Goal goal{std::max(residual, coarseResidual), K - 1, coarseIterations};
    start.values = iterate<K>(problem, cycle, level, start.x, goal).eigenvalues;
  }
  return start;
}

/// The `wanted` first of K pairs to the tolerance.
template <int K>
Eigenspace refine(const FractureGraph& graph, const GraphMultigrid& grid, const BlockVector<K, double>& start,
                  double residual, int wanted) {
  MultigridCycle<K> cycle(grid);
  BlockVector<K, double> x = start.size() < grid.levels[0].rows.size() ? prolonged<K>(grid.levels[0], start) : start;
  const EigenProblem<double> problem{graph.first, graph.targets, graph.weights, grid.levels[0].mass};
  const EigenReport<K> report = iterate<K>(problem, cycle, 0, x, Goal{residual, wanted, mostIterations});
  Eigenspace space{{report.eigenvalues.begin(), report.eigenvalues.end()}, {}, 0, report.iterations};
  for (int c = 0; c < K; ++c) {
    std::vector<double>& vector = space.vectors.emplace_back(x.size());
    forNodes(x.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) vector[i] = x[i][c];
    });
  }
  return space;
}

/// A larger block, where several vectors belong to the first eigenvalue.
template <int K>
Eigenspace widerSpace(const FractureGraph& graph, const GraphMultigrid& grid, double residual) {
  return refine<K>(graph, grid, coarseStart<K>(grid, residual).x, residual, K - 1);
}

template <int K, std::size_t More>
BlockVector<K, double> firstColumns(const AlignedVector<std::array<double, More>>& x) {
  BlockVector<K, double> columns(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) std::copy_n(x[i].begin(), K, columns[i].begin());
  return columns;
}

/// As many vectors as have eigenvalues near the first, as the coarse levels see it: without those (three of anything
/// round) they would creep into the first and out again. Two at least where the second eigenvalue is to be known.
Eigenspace narrowSpace(const FractureGraph& graph, const GraphMultigrid& grid, double residual) {
  constexpr double near = 1.5, rough = 1e-3;
  const EigenStart<3> start = coarseStart<3>(grid, residual);
  if (start.values[2] < near * start.values[0]) return refine<3>(graph, grid, start.x, residual, 1);
  if (residual > rough && start.values[1] > near * start.values[0])
    return refine<1>(graph, grid, firstColumns<1>(start.x), residual, 1);
  return refine<2>(graph, grid, firstColumns<2>(start.x), residual, 1);
}

/// A function without any symmetry, so that hardly any vector is orthogonal to it.
std::vector<double> compass(const FractureGraph& graph) {
  const auto n = static_cast<std::size_t>(graph.nodeCount());
  std::vector<double> values(n);
  const Random random(0, Stream::eigenvectorStart);
  Box3 box;
  for (const Vec3d& p : graph.places) box.include(p);
  const double size = graph.places.empty() ? 0 : length(box.size());
  const Vec3d slope(1, 0.618, 0.382);
  forNodes(n, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i)
      values[i] = size > 0 ? portableExp(dot(slope, graph.places[i] - box.lower) * (2 / size)) : random.uniform(i);
  });
  return values;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return sumOverNodes<1>(a.size(), [&](std::uint32_t begin, std::uint32_t end, auto& sum) {
    for (std::uint32_t i = begin; i < end; ++i) sum[0] += a[i] * b[i];
  })[0];
}

/// The projection of the compass on the first `dimension` vectors, of unit length.
std::vector<double> canonicalVector(const FractureGraph& graph, const Eigenspace& space, std::size_t dimension) {
  const std::vector<double> needle = compass(graph);
  std::vector<double> result(needle.size(), 0);
  for (std::size_t c = 0; c < dimension; ++c) {
    const double along = product(needle, space.vectors[c]);
    forNodes(result.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) result[i] += along * space.vectors[c][i];
    });
  }
  const double norm = std::sqrt(product(result, result));
  CHECK(norm > 0, "an eigenvector without direction");
  for (double& v : result) v /= norm;
  return result;
}

Eigenspace eigenspace(const FractureGraph& graph, const EigenTolerance& tolerance) {
  if (graph.nodeCount() <= directLimit) return solveDirectly(graph);
  const GraphMultigrid grid(graph);
  constexpr double suspicious = 1e-4;  // the third eigenvalue is known to about the tolerance only
  Eigenspace space = narrowSpace(graph, grid, tolerance.residual);
  if (space.multiplicity(suspicious) >= 2) space = widerSpace<4>(graph, grid, tolerance.residual);
  if (space.multiplicity(sameEigenvalue(tolerance)) == 4) space = widerSpace<6>(graph, grid, tolerance.residual);
  return space;
}

}  // namespace

FiedlerVector fiedlerVector(const FractureGraph& graph, const EigenTolerance& tolerance) {
  CHECK(graph.nodeCount() >= 2, "{} nodes", graph.nodeCount());
  const Eigenspace space = eigenspace(graph, tolerance);
  CHECK(space.values[0] > 0, "eigenvalue {}: the graph is not connected", space.values[0]);
  FiedlerVector result;
  result.eigenvalues = {0, space.values[0]};
  if (space.values.size() > 1) result.eigenvalues.push_back(space.values[1]);
  result.vector = canonicalVector(graph, space, space.multiplicity(sameEigenvalue(tolerance)));
  result.residual = relativeResidual(graph, result.vector, space.values[0]);
  result.iterations = space.iterations;
  return result;
}

}  // namespace brisance
