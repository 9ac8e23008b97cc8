// How fast the gas is. Rows are named What/Input/Size/Who; each carries its threads and the accuracy reached,
// recomputed in double precision from the result.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstring>

#include "base/parallel.h"
#include "fluid/fluid_step.h"
#include "fluid/solid_fractions.h"
#include "gas_inputs.h"

namespace brisance {
namespace {

using namespace bench;

/// A ball of gas that expands in the middle of the box.
void addSource(FluidState& gas) {
  constexpr double radius = 0.15;  // [m]
  constexpr float rate = 5;        // [1/s]
  Grid3<float>& source = gas.divergence;
  for (int k = 0; k < source.size.z; ++k)
    for (int j = 0; j < source.size.y; ++j)
      for (int i = 0; i < source.size.x; ++i)
        if (!gas.solid.inside(i, j, k) && length(source.position(i, j, k) - Vec3d(.5, .5, .5)) < radius)
          source(i, j, k) = rate;
}

FluidState sourceIn(const FluidSettings& settings, const SolidStamp& solid) {
  FluidState gas = makeFluid(settings, solid, 1);
  addSource(gas);
  return gas;
}

void count(benchmark::State& state, const FluidState& gas, int iterations) {
  state.counters["threads"] = threadCount();
  state.counters["divergence"] = divergenceError(gas);
  state.counters["iterations"] = iterations;
}

void stepGas(benchmark::State& state, int cells) {
  FluidSettings settings = boxOf(cells);
  settings.buoyancy = 0.01;
  settings.vorticityConfinement = 0.5;
  FluidState gas = sourceIn(settings, stampSolids(settings, {}));
  FluidScratch scratch;
  FluidReport report;
  constexpr double sootPerMass = 1, largestSource = 5;  // [1], [1/s]
  for (auto _ : state)
    report = stepFluid(gas, settings, sootPerMass, longestStep(gas, settings, largestSource), scratch);
  count(state, gas, report.pressure.iterations);
}

/// What the memory gives at most: a copy of 512 MB by all threads.
void copyArray(benchmark::State& state) {
  constexpr std::int64_t bytes = std::int64_t{512} << 20, grain = 1 << 22;
  std::vector<char> from(bytes, 1), to(bytes);
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state)
    parallelFor(0, bytes, grain, [&](std::int64_t first, std::int64_t last) {
      std::memcpy(to.data() + first, from.data() + first, static_cast<std::size_t>(last - first));
    });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  state.counters["GB/s"] = 2e-9 * static_cast<double>(bytes * state.iterations()) / seconds;  // read and written
  state.counters["threads"] = threadCount();
}

template <class... Arguments>
void add(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  add("Step/DonorCell/64/Brisance", stepGas, 64);
  add("Step/DonorCell/128/Brisance", stepGas, 128);
  add("Copy/Array/512M/Memory", copyArray);
  return true;
}();

}  // namespace
}  // namespace brisance
