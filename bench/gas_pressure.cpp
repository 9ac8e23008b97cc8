// The pressure alone: b -> x. Rows Pressure/Input/Size/Who, each with its threads and its true relative residual.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <functional>

#include "base/parallel.h"
#include "fluid/multigrid.h"
#include "fluid/solid_fractions.h"
#include "gas_inputs.h"
#include "gas_peers.h"

namespace brisance::bench {
namespace {

constexpr double goal = 1e-3;  // true relative residual with solids
constexpr int mostIterations = 200;

struct Problem {
  FluidSettings settings;
  SolidStamp solid;
  CellField b;
};

Problem problemOf(int cells, FaceKind kind, bool solids) {
  const FluidSettings settings = boxOf(cells, kind);
  const SolidStamp solid = solids ? threeSolids(settings) : stampSolids(settings, {});
  return {settings, solid, sourceField(solid)};
}

/// Solves x in place of b; returns iterations.
using Solve = std::function<int(CellField&)>;

void measure(benchmark::State& state, const Problem& problem, int threads, const Solve& solve) {
  CellField x = problem.b;
  int iterations = 0;
  for (auto _ : state) {
    x.values = problem.b.values;
    const auto start = std::chrono::steady_clock::now();
    iterations = solve(x);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.counters["threads"] = threads;
  state.counters["residual"] = trueResidual(problem.solid, problem.settings.faces, problem.b, x);
  state.counters["iterations"] = iterations;
}

void fastPoisson(benchmark::State& state, int cells, FaceKind kind, bool solids, int threads) {
  const ThreadLimit limit(threads);
  const Problem problem = problemOf(cells, kind, solids);
  const BoxPoisson box(problem.settings.cells, problem.settings.faces);
  const SolidFaces surface = solids ? findSurface(problem.solid, box) : SolidFaces{};
  CellField work(box.layout());
  SurfaceVectors vectors;
  measure(state, problem, threadCount(), [&](CellField& x) {
    return solveFastPoisson(box, surface, 0.95 * goal, mostIterations, x, work, vectors).iterations;
  });
}

void multigrid(benchmark::State& state, int cells, FaceKind kind, bool solids) {
  const Problem problem = problemOf(cells, kind, solids);
  Multigrid solver(problem.solid, problem.settings.faces);
  measure(state, problem, threadCount(),
          [&](CellField& x) { return solver.solve(x, 0.95 * goal, mostIterations).iterations; });
}

void surfaceSearch(benchmark::State& state, int cells) {
  const Problem problem = problemOf(cells, FaceKind::open, true);
  const BoxPoisson box(problem.settings.cells, problem.settings.faces);
  SolidFaces surface;
  for (auto _ : state) surface = findSurface(problem.solid, box);
  state.counters["cells"] = static_cast<double>(surface.cell.size());
  state.counters["threads"] = threadCount();
}

void project(benchmark::State& state, int cells, bool solids) {
  const FluidSettings settings = boxOf(cells);
  const FluidState atRest = [&] {
    const SolidStamp solid = solids ? threeSolids(settings) : stampSolids(settings, {});
    FluidState gas = makeFluid(settings, solid, 1);
    const CellField b = sourceField(solid);
    for (int k = 0; k < cells; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) gas.divergence(i, j, k) = b(i, j, k);
    return gas;
  }();
  FluidState gas = atRest;
  PressureScratch scratch;
  PressureReport report;
  constexpr double dt = 0.01;  // [s]
  for (auto _ : state) {
    gas.velocity = atRest.velocity;
    const auto start = std::chrono::steady_clock::now();
    report = brisance::project(gas, settings, dt, scratch);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.counters["threads"] = threadCount();
  state.counters["divergence"] = divergenceError(gas);
  state.counters["iterations"] = report.iterations;
}

#if defined(BRISANCE_HAS_FFTW) || defined(BRISANCE_HAS_HYPRE) || defined(BRISANCE_HAS_OPENVDB)
using MakePeer = PeerSolve (*)(const PeerProblem&);

void peer(benchmark::State& state, int cells, bool solids, MakePeer make) {
  const Problem problem = problemOf(cells, FaceKind::noSlip, solids);
  const PressureOperator op = makePressureOperator(problem.solid, problem.settings.faces);
  const PeerSolve solve = make({problem.solid, op, problem.b, goal, threadCount()});
  int threads = 1;
  measure(state, problem, threads, [&](CellField& x) {
    const PeerResult result = solve(x);
    threads = result.threads;
    return result.iterations;
  });
  state.counters["threads"] = threads;
}

void addPeer(const std::string& input, const std::string& who, int cells, bool solids, MakePeer make) {
  benchmark::RegisterBenchmark(fmt::format("Pressure/{}/{}/{}", input, cells, who).c_str(), peer, cells, solids, make)
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}
#endif

template <class... Arguments>
void add(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond)->UseManualTime();
}

const bool registered = [] {
  constexpr int allThreads = 0;
  for (const int cells : {64, 128, 256}) {
    const std::string size = fmt::format("/{}/", cells);
    add("Pressure/Box" + size + "Brisance", fastPoisson, cells, FaceKind::noSlip, false, allThreads);
    add("Pressure/Box" + size + "BrisanceOneThread", fastPoisson, cells, FaceKind::noSlip, false, 1);
    add("Pressure/OpenBox" + size + "Brisance", fastPoisson, cells, FaceKind::open, false, allThreads);
    add("Pressure/PeriodicBox" + size + "Brisance", fastPoisson, cells, FaceKind::periodic, false, allThreads);
#ifdef BRISANCE_HAS_FFTW
    addPeer("Box", "Fftw", cells, false, makeFftw);
#endif
#ifdef BRISANCE_HAS_HYPRE
    addPeer("Box", "Hypre", cells, false, makeHypre);
#endif
    add("Pressure/Solids" + size + "Brisance", fastPoisson, cells, FaceKind::noSlip, true, allThreads);
    add("Pressure/Solids" + size + "BrisanceOneThread", fastPoisson, cells, FaceKind::noSlip, true, 1);
    add("Pressure/OpenSolids" + size + "Brisance", fastPoisson, cells, FaceKind::open, true, allThreads);
    add("Pressure/Solids" + size + "BrisanceMultigrid", multigrid, cells, FaceKind::noSlip, true);
    add("Pressure/OpenSolids" + size + "BrisanceMultigrid", multigrid, cells, FaceKind::open, true);
#ifdef BRISANCE_HAS_HYPRE
    addPeer("Solids", "Hypre", cells, true, makeHypre);
#endif
    benchmark::RegisterBenchmark(("Surface/Solids" + size + "Brisance").c_str(), surfaceSearch, cells)
        ->Unit(benchmark::kMillisecond);
    add("Projection/Box" + size + "Brisance", project, cells, false);
    add("Projection/Solids" + size + "Brisance", project, cells, true);
  }
#ifdef BRISANCE_HAS_OPENVDB
  addPeer("Box", "OpenVdb", 64, false, makeOpenVdb);
#endif
  return true;
}();

}  // namespace
}  // namespace brisance::bench
