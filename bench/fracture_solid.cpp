// Solid pieces: 100 of three bodies, flat (one cell each) and rough (fused from small cells). The accuracy is
// recomputed here from the pieces' triangles.
#include <benchmark/benchmark.h>

#include "assets/sample_meshes.h"
#include "base/parallel.h"
#include "fracture/solid_fracture.h"

namespace brisance {
namespace {

constexpr int pieceCount = 100, threads = 2;

/// Edges between places that are not used once in each direction.
long openEdges(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size()), first(mesh.vertices.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  const auto key = [&](std::uint32_t v) {
    return std::tuple(mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t n = 0; n < order.size(); ++n)
    first[order[n]] = n > 0 && key(order[n]) == key(order[n - 1]) ? first[order[n - 1]] : order[n];
  std::vector<std::array<std::uint32_t, 3>> edges;  // low, high, direction
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = first[t[k]], b = first[t[(k + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  std::sort(edges.begin(), edges.end());
  long open = 0;
  for (std::size_t n = 0; n < edges.size(); n += 2)
    if (n + 1 == edges.size() || edges[n][0] != edges[n + 1][0] || edges[n][1] != edges[n + 1][1] ||
        edges[n][2] == edges[n + 1][2]) {
      ++open;
      --n;
    }
  return open;
}

double volumeOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  return sum / 6;
}

TriangleMesh bodyOf(const std::string& name, long triangles) {
  if (name == "Sphere") return samples::bumpySphere(triangles);
  return name == "Dumbbell" ? samples::dumbbell(triangles) : samples::torus(triangles);
}

void solid(benchmark::State& state, const std::string& name, long triangles, bool rough) {
  const ThreadLimit limit(threads);
  const TriangleMesh mesh = bodyOf(name, triangles);
  FractureSettings settings;
  settings.pieces = pieceCount;
  if (!rough) settings.method = Voronoi{};
  FracturedBody body;
  for (auto _ : state) body = fractureSolid(mesh, settings);
  double volume = 0, open = 0;
  for (const Piece& piece : body.pieces) {
    volume += volumeOf(piece.mesh);
    open += static_cast<double>(openEdges(piece.mesh));
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  state.counters["threads"] = threads;
  state.counters["pieces"] = static_cast<double>(body.pieces.size());
  state.counters["open_edges"] = open;
  state.counters["volume_error"] = std::abs(volume / volumeOf(mesh) - 1);
}

const bool registered = [] {
  for (const std::string name : {"Sphere", "Dumbbell", "Torus"})
    for (const auto& [size, triangles] :
         {std::pair("10k", 10000L), std::pair("100k", 100000L), std::pair("1M", 1000000L)})
      for (const bool rough : {false, true})
        benchmark::RegisterBenchmark(("Solid100/" + name + "/" + size + "/Brisance" + (rough ? "_rough" : "")).c_str(),
                                     [=](benchmark::State& state) { solid(state, name, triangles, rough); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
  return true;
}();

}  // namespace
}  // namespace brisance
