// Breadth-first pieces of a sphere, beside METIS' (k-way, contiguous) on the same graph.
#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <numeric>
#include <string>

#include "assets/sample_meshes.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fracture/breadth_first.h"
#include "fracture/refine_cut.h"

#ifdef BRISANCE_HAS_METIS
#include <metis.h>
#endif

namespace brisance {
namespace {

constexpr int pieces = 512, repetitions = 5;

/// Triangles and vertices in random order: what a file from elsewhere may be.
TriangleMesh shuffled(TriangleMesh mesh) {
  const Random random(1, Stream::test);
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0u);
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.below(i, i)]);
  const std::vector<Vec3d> vertices = mesh.vertices;
  for (std::size_t v = 0; v < place.size(); ++v) mesh.vertices[place[v]] = vertices[v];
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = place[v];
  for (std::size_t i = mesh.triangles.size(); i > 1; --i)
    std::swap(mesh.triangles[i - 1], mesh.triangles[random.below(i, 2 * i)]);
  return mesh;
}

struct Input {
  TriangleMesh mesh;
  FractureGraph graph;
};

const Input& input(long triangles, bool shuffle) {
  static std::map<std::pair<long, bool>, Input> inputs;
  Input& result = inputs[{triangles, shuffle}];
  if (result.mesh.triangles.empty()) {
    result.mesh = samples::bumpySphere(triangles);
    if (shuffle) result.mesh = shuffled(std::move(result.mesh));
    result.graph = triangleGraph(result.mesh);
  }
  return result;
}

// What a partition is worth, told apart from those who made it.

double cutEdges(const FractureGraph& graph, const std::vector<int>& pieceOf) {
  std::int64_t ends = 0;
  for (std::uint32_t node = 0; node < pieceOf.size(); ++node)
    for (const std::uint32_t next : graph.neighbours(node)) ends += pieceOf[next] != pieceOf[node];
  return static_cast<double>(ends) / 2;
}

double imbalance(const std::vector<int>& pieceOf) {
  std::vector<int> sizes(pieces, 0);
  for (const int piece : pieceOf) ++sizes.at(piece);
  return *std::max_element(sizes.begin(), sizes.end()) * static_cast<double>(pieces) /
         static_cast<double>(pieceOf.size());
}

/// Connected parts beyond one for each piece that has any node.
double strayIslands(const FractureGraph& graph, const std::vector<int>& pieceOf) {
  std::vector<std::uint32_t> open;
  std::vector<bool> seen(pieceOf.size(), false);
  int islands = 0;
  for (std::uint32_t start = 0; start < pieceOf.size(); ++start) {
    if (seen[start]) continue;
    ++islands;
    seen[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const std::uint32_t next : graph.neighbours(node)) {
        if (seen[next] || pieceOf[next] != pieceOf[node]) continue;
        seen[next] = true;
        open.push_back(next);
      }
    }
  }
  return islands - pieces;
}

using Partitioner = std::function<std::vector<int>(const Input&)>;

void measure(benchmark::State& state, long triangles, bool shuffle, const Partitioner& partitioner) {
  const Input& in = input(triangles, shuffle);
  std::vector<int> pieceOf;
  for (auto _ : state) pieceOf = partitioner(in);
  state.counters["cut"] = cutEdges(in.graph, pieceOf);
  state.counters["imbalance"] = imbalance(pieceOf);
  state.counters["islands"] = strayIslands(in.graph, pieceOf);
  state.counters["threads"] = threadCount();
}

#ifdef BRISANCE_HAS_METIS
static_assert(sizeof(idx_t) == sizeof(std::uint32_t));

std::vector<int> metis(const Input& in) {
  static std::map<const Input*, std::pair<std::vector<idx_t>, std::vector<idx_t>>> rows;  // its own numbers, once
  auto& [first, targets] = rows[&in];
  if (first.empty()) {
    first.assign(in.graph.first.begin(), in.graph.first.end());
    targets.assign(in.graph.targets.begin(), in.graph.targets.end());
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = 1;
  idx_t nodes = in.graph.nodeCount(), constraints = 1, parts = pieces, cut = 0;
  std::vector<int> pieceOf(in.graph.nodeCount());
  METIS_PartGraphKway(&nodes, &constraints, first.data(), targets.data(), nullptr, nullptr, nullptr, &parts, nullptr,
                      nullptr, options, &cut, pieceOf.data());
  return pieceOf;
}
#endif

void add(const std::string& size, long triangles, bool shuffle) {
  const std::string prefix = std::string("Pieces512/Sphere") + (shuffle ? "Shuffled/" : "/") + size + "/";
  const auto row = [&](const char* who, const Partitioner& partitioner) {
    benchmark::RegisterBenchmark((prefix + who).c_str(), measure, triangles, shuffle, partitioner)
        ->Unit(benchmark::kMillisecond)
        ->Repetitions(repetitions)
        ->ReportAggregatesOnly()
        ->UseRealTime();
  };
  row("Brisance", [](const Input& in) { return partitionBreadthFirst(in.graph, pieces).pieceOf; });
  row("Brisance_from_mesh",
      [](const Input& in) { return partitionBreadthFirst(triangleGraph(in.mesh), pieces).pieceOf; });
  row("Brisance_refined",
      [](const Input& in) { return refineCut(in.graph, partitionBreadthFirst(in.graph, pieces)).pieceOf; });
#ifdef BRISANCE_HAS_METIS
  row("Metis", metis);
#endif
}

const bool added = [] {
  for (const bool shuffle : {false, true}) {
    add("100k", 100'000, shuffle);
    add("1M", 1'000'000, shuffle);
  }
  return true;
}();

}  // namespace
}  // namespace brisance
