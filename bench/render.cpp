// How fast the renderer is. Rows are named What/Input/Size/Who; peers see the same rays and the same volume in the same
// run.
#include <benchmark/benchmark.h>

#include <atomic>
#include <map>
#include <mutex>

#include "base/parallel.h"
#include "render_inputs.h"

namespace brisance {
namespace {

using namespace bench;

const MaterialTable& anyMaterial() {
  static const MaterialTable table = [] {
    RenderSettings settings;
    settings.materials = {{"any", Material{}}};
    return MaterialTable(settings, TextureLibrary{});
  }();
  return table;
}

const std::vector<FrameBody>& balls() {
  static const std::vector<FrameBody> bodies = noisyBalls();
  return bodies;
}
const SceneGeometry& ballGeometry() {
  static const SceneGeometry geometry(balls(), anyMaterial(), 0);
  return geometry;
}
const std::vector<Ray>& raysOf(bool bounced) {
  static const std::vector<Ray> primary = cameraRays(), second = bouncedRays(ballGeometry(), primary);
  return bounced ? second : primary;
}

void report(benchmark::State& state, std::size_t rays, const RayCounts& counts) {
  state.counters["threads"] = threadCount();
  state.counters["Mray/s"] = benchmark::Counter(
      1e-6 * static_cast<double>(rays) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["hits"] = static_cast<double>(counts.hits);
  state.counters["distance"] = counts.distances / static_cast<double>(counts.hits);
}

template <class Count>
RayCounts counted(const std::vector<Ray>& rays, const Count& count) {
  constexpr std::int64_t grain = 4096;
  RayCounts all;
  std::mutex adding;
  parallelFor(0, std::ssize(rays), grain, [&](std::int64_t first, std::int64_t last) {
    RayCounts some;
    count(first, last, some);
    const std::lock_guard lock(adding);
    all.hits += some.hits;
    all.distances += some.distances;
  });
  return all;
}

void add(RayCounts& counts, const FoundTriangle& found) {
  if (found.isNone()) return;
  ++counts.hits;
  counts.distances += found.distance;
}

RayCounts findPackets(const std::vector<Ray>& rays) {
  return counted(rays, [&](std::int64_t first, std::int64_t last, RayCounts& counts) {
    FoundTriangle found[SceneGeometry::packet];
    for (; first < last; first += SceneGeometry::packet) {
      const std::span some(&rays[first],
                           static_cast<std::size_t>(std::min<std::int64_t>(SceneGeometry::packet, last - first)));
      ballGeometry().find(some, found);
      for (std::size_t n = 0; n < some.size(); ++n) add(counts, found[n]);
    }
  });
}

/// With the normal, material and texture of each hit.
RayCounts findSurfaces(const std::vector<Ray>& rays) {
  return counted(rays, [&](std::int64_t first, std::int64_t last, RayCounts& counts) {
    for (; first < last; ++first) {
      SurfaceHit hit;
      if (!ballGeometry().closest(rays[first], hit)) continue;
      benchmark::DoNotOptimize(hit);
      ++counts.hits;
      counts.distances += hit.distance;
    }
  });
}

template <class Trace>
void trace(benchmark::State& state, bool bounced, const Trace& make) {
  const auto& rays = raysOf(bounced);
  const auto run = make();
  RayCounts counts = run(rays);
  for (auto _ : state) counts = run(rays);
  report(state, rays.size(), counts);
}

/// Of every some hundredth path: root mean square difference from the fine integral, over that one's mean.
double marchError(const std::vector<GasPath>& paths, const std::vector<GasPassage>& passages) {
  constexpr std::size_t every = 1009;
  double squares = 0, sum = 0;
  int count = 0;
  for (std::size_t n = 0; n < paths.size(); n += every, ++count) {
    const GasPassage fine = finePassage(paths[n]);
    squares += std::pow(passages[n].light.x - fine.light.x, 2);
    sum += fine.light.x;
  }
  return std::sqrt(squares / count) / (sum / count);
}

void march(benchmark::State& state, const MarchAll& run) {
  static const std::vector<GasPath> paths = pathsThroughExplosion();
  std::vector<GasPassage> passages(paths.size());
  run(paths, passages);
  for (auto _ : state) run(paths, passages);
  state.counters["threads"] = threadCount();
  state.counters["error"] = marchError(paths, passages);
}

const GasMedium& explosionGas() {
  static const GasMedium gas(explosion(), explosionSettings());
  return gas;
}

void marchGas(const std::vector<GasPath>& paths, std::vector<GasPassage>& passages) {
  const GasMedium& gas = explosionGas();
  parallelFor(0, std::ssize(paths), 1024, [&](std::int64_t first, std::int64_t last) {
    gas.march(std::span(paths).subspan(first, last - first), std::span(passages).subspan(first, last - first));
  });
}

void build(benchmark::State& state, const std::vector<FrameBody>& bodies) {
  for (auto _ : state) SceneGeometry(bodies, anyMaterial(), 0);
  double triangles = 0;
  for (const FrameBody& body : bodies) triangles += static_cast<double>(body.mesh->triangles.size());
  state.counters["triangles"] = triangles;
  state.counters["threads"] = 1;
}

template <class Function>
void add(const std::string& name, const Function& function) {
  benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond)->UseRealTime();
}

const bool registered = [] {
  using State = benchmark::State;
  const auto packets = [](bool robust) { return [robust] { return makeEmbreePackets(balls(), robust); }; };
  const auto singles = [](bool robust) { return [robust] { return makeEmbreeSingles(balls(), robust); }; };
  add("Primary/Noisy/1M/Brisance", [](State& s) { trace(s, false, [] { return findPackets; }); });
  add("Primary/Noisy/1M/Embree", [=](State& s) { trace(s, false, packets(false)); });
  add("Primary/Noisy/1M/Embree_robust", [=](State& s) { trace(s, false, packets(true)); });
  add("Bounce/Noisy/1M/Brisance", [](State& s) { trace(s, true, [] { return findSurfaces; }); });
  add("Bounce/Noisy/1M/Embree", [=](State& s) { trace(s, true, singles(false)); });
  add("Bounce/Noisy/1M/Embree_robust", [=](State& s) { trace(s, true, singles(true)); });
  add("March/Explosion/1080p/Brisance", [](State& s) { march(s, marchGas); });
#ifdef BRISANCE_HAS_NANOVDB
  add("March/Explosion/1080p/NanoVdb", [](State& s) { march(s, makeNanoVdb()); });
#endif
  add("Bvh/Noisy/1M/Brisance", [](State& s) { build(s, balls()); });
  add("Bvh/Shards/512/Brisance", [](State& s) { build(s, shards()); });
  return true;
}();

}  // namespace
}  // namespace brisance
