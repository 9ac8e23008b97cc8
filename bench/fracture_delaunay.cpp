// Triangulating random points of the plane, from their coordinates in to triangles out.
#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "mesh/triangulation.h"
#ifdef BRISANCE_HAS_CGAL
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace brisance {
namespace {

constexpr int million = 1000000;
constexpr std::uint64_t seed = 1;

std::vector<Vec2d> randomPoints(int count) { return panePoints(1, 1, count, 0, seed); }

void run(benchmark::State& state, const Triangulation& method, int threads) {
  const ThreadLimit limit(threads);
  const std::vector<Vec2d> points = randomPoints(million);
  std::size_t triangles = 0;
  for (auto _ : state) triangles = triangulate(points, method, seed).triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["threads"] = threadCount();
}
void delaunayOnAllThreads(benchmark::State& state) { run(state, Delaunay{}, 0); }
void delaunayOnOneThread(benchmark::State& state) { run(state, Delaunay{}, 1); }
void trisection(benchmark::State& state) { run(state, Trisection{}, 0); }
BENCHMARK(delaunayOnAllThreads)->Name("Delaunay/Random/1M/Brisance")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(delaunayOnOneThread)
    ->Name("Delaunay/Random/1M/BrisanceOneThread")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(trisection)->Name("Trisection/Random/1M/Brisance")->Unit(benchmark::kMillisecond)->UseRealTime();

#ifdef BRISANCE_HAS_CGAL
/// CGAL has no parallel Delaunay triangulation of the plane.
void cgal(benchmark::State& state) {
  using Triangles = CGAL::Delaunay_triangulation_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
  std::vector<Triangles::Point> points;
  for (const Vec2d& p : randomPoints(million)) points.emplace_back(p.x, p.y);
  std::size_t triangles = 0;
  for (auto _ : state) triangles = Triangles(points.begin(), points.end()).number_of_faces();
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["threads"] = 1;
}
BENCHMARK(cgal)->Name("Delaunay/Random/1M/Cgal")->Unit(benchmark::kMillisecond)->UseRealTime();
#endif

}  // namespace
}  // namespace brisance
