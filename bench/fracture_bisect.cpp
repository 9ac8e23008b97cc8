// The second eigenvector of a weighted vertex graph: from the graph to the vector, everything included. The residual
// |L x - lambda x| / (lambda |x|) and the share of nodes on another side than at 1e-6 are computed apart.
#include <benchmark/benchmark.h>

#include <memory>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "bench/fracture_peers.h"
#include "bench/peak_memory.h"
#include "fracture/curvature.h"
#include "fracture/fiedler.h"

namespace brisance {
namespace {

/// The graph at hand, made once for all rows on it.
struct Subject {
  std::string name;
  FractureGraph graph;
  std::vector<double> reference;  ///< the vector to 1e-6
};

TriangleMesh meshOf(const std::string& shape, long triangles) {
  return shape == "Sphere" ? samples::bumpySphere(triangles) : samples::dumbbell(triangles);
}

const Subject& subject(const std::string& shape, long triangles, CurvatureWeights weights) {
  static Subject current;
  const std::string name = fmt::format("{}/{}/{}", shape, triangles, static_cast<int>(weights));
  if (current.name == name) return current;
  current = {name, {}, {}};
  Curvature curvature;
  curvature.weights = weights;
  current.graph = vertexGraph(meshOf(shape, triangles), curvature).graph;
  current.reference = fiedlerVector(current.graph).vector;
  return current;
}

double residualOf(const FractureGraph& graph, const std::vector<double>& x) {
  std::vector<double> image(x.size(), 0);
  double energy = 0, norm = 0, left = 0;
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
      image[i] += graph.weights[k] * (x[i] - x[graph.targets[k]]);
    energy += x[i] * image[i];
    norm += x[i] * x[i];
  }
  const double lambda = energy / norm;
  for (std::size_t i = 0; i < x.size(); ++i) left += (image[i] - lambda * x[i]) * (image[i] - lambda * x[i]);
  return std::sqrt(left / norm) / lambda;
}

/// The sign of an eigenvector is nobody's: the lesser of the two counts.
double sidesChanged(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += (a[i] < 0) != (b[i] < 0);
  return static_cast<double>(std::min(different, a.size() - different)) / static_cast<double>(a.size());
}

template <class Solve>
void bisect(benchmark::State& state, const std::string& shape, long triangles, CurvatureWeights weights, int threads,
            const Solve& solve) {
  const Subject& s = subject(shape, triangles, weights);
  const PeakMemory memory;
  std::vector<double> vector = solve(s.graph);  // not timed: the memory it takes is given back before, and faults in
  const double peak = memory.grownBy();
  for (auto _ : state) vector = solve(s.graph);
  state.counters["threads"] = threads;
  state.counters["residual"] = residualOf(s.graph, vector);
  state.counters["sides_changed"] = sidesChanged(vector, s.reference);
  state.counters["peak_MB"] = peak;
}

const bool registered = [] {
  using Solve = std::function<std::vector<double>(const FractureGraph&)>;
  const auto add = [](const std::string& shape, const std::string& size, long triangles, CurvatureWeights weights,
                      const std::string& who, int threads, const Solve& solve) {
    const std::string row =
        fmt::format("Bisect/{}{}/{}/{}", shape, weights == CurvatureWeights::raw ? "Raw" : "", size, who);
    benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
      bisect(state, shape, triangles, weights, threads, solve);
    })->Unit(benchmark::kMillisecond);
  };
  const Solve ours = [](const FractureGraph& graph) { return fiedlerVector(graph).vector; };
  const Solve oursRoughly = [](const FractureGraph& graph) { return fiedlerVector(graph, {1e-2}).vector; };
  const int threads = threadCount();
  const std::vector<std::pair<std::string, long>> sizes{{"10k", 10'000}, {"100k", 100'000}, {"1M", 1'000'000}};
  for (const CurvatureWeights weights : {CurvatureWeights::clipped, CurvatureWeights::raw})
    for (const std::string shape : {"Dumbbell", "Sphere"})
      for (const auto& [size, triangles] : sizes) {
        add(shape, size, triangles, weights, "Brisance", threads, ours);
        add(shape, size, triangles, weights, "Brisance_1e-2", threads, oursRoughly);
#ifdef BRISANCE_HAS_HYPRE
        add(shape, size, triangles, weights, "Hypre", 1, peers::hypreFiedlerVector);
#endif
#ifdef BRISANCE_HAS_SPECTRA
        add(shape, size, triangles, weights, "Spectra", 1, peers::spectraFiedlerVector);
#endif
      }
  add("Sphere", "4M", 4'000'000, CurvatureWeights::clipped, "Brisance", threads, ours);
  return true;
}();

}  // namespace
}  // namespace brisance
