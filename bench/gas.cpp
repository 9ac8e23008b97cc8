// How fast the gas is. Rows are named What/Input/Size/Who; each carries its threads and the accuracy reached,
// recomputed in double precision from the result.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "base/aligned.h"
#include "base/lane_sum.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector_path.h"
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

/// A hot ball that rises while it expands.
FluidState burningIn(const FluidSettings& settings) {
  FluidState gas = sourceIn(settings, stampSolids(settings, {}));
  for (std::int64_t n = 0; n < gas.divergence.count(); ++n) {
    gas.burnRate.values[n] = gas.divergence.values[n];
    gas.heatRate.values[n] = 200 * gas.divergence.values[n];
  }
  return gas;
}

/// The bytes of a step once: its seven fields copied, its three sources read.
class StepBytes {
 public:
  explicit StepBytes(int cells) : count_(std::int64_t{1} * cells * cells * cells) {}
  void move() {
    const std::int64_t grain = count_ / 64;
    for (std::size_t n = 0; n < fields_.size(); ++n)
      parallelFor(0, count_, grain, [&](std::int64_t first, std::int64_t last) {
        std::memcpy(&moved_[n][first], &fields_[n][first], static_cast<std::size_t>(last - first) * sizeof(float));
      });
    for (const auto& source : sources_)
      sum_ += parallelSum(count_, grain, [&](std::int64_t first, std::int64_t last) {
        double part = 0;
        runWide([&] { part = laneMax(last - first, [&](std::int64_t i) { return source[first + i]; }); });
        return part;
      });
    benchmark::DoNotOptimize(sum_);
  }

 private:
  using Field = AlignedVector<float>;
  std::int64_t count_;
  std::vector<Field> fields_ = std::vector<Field>(7, Field(count_, 1)), moved_ = fields_;
  std::vector<Field> sources_ = std::vector<Field>(3, Field(count_, 1));
  double sum_ = 0;
};

/// Median of seven, of the same run as the row it stands beside.
double millisecondsOfBytes(int cells) {
  StepBytes bytes(cells);
  bytes.move();
  std::array<double, 7> times;
  for (double& time : times) {
    const auto start = std::chrono::steady_clock::now();
    bytes.move();
    time = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

struct StepInput {
  AdvectionScheme advection;
  double whirls = 0;
  bool hotEverywhere = false;
};

/// Smoke and heat in every cell, none of which a step may leave out.
void heatEverywhere(FluidState& gas) {
  for (std::int64_t n = 0; n < gas.temperature.count(); ++n) {
    gas.temperature.values[n] += 100 + static_cast<float>(n % 7);
    gas.soot.values[n] = 0.1f;
    gas.flame.values[n] = 0.2f;
  }
}

/// `bytes` is what moving its bytes once takes [ms], `times` how many times that the step takes.
void stepGas(benchmark::State& state, int cells, const StepInput& input) {
  FluidSettings settings = boxOf(cells);
  settings.buoyancy = 0.01;
  settings.advection = input.advection;
  settings.vorticityConfinement = input.whirls;
  FluidState gas = burningIn(settings);
  if (input.hotEverywhere) heatEverywhere(gas);
  FluidScratch scratch;
  FluidReport report;
  StepLimits limits = limitsOf(gas);
  constexpr double sootPerMass = 1, largestSource = 5;  // [1], [1/s]
  const auto step = [&] {
    const double dt = longestStep(gas, settings, largestSource, limits);
    report = stepFluid(gas, settings, sootPerMass, dt, scratch, limits);
    limits = report.next;
  };
  step();  // fresh memory comes once in a film
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) step();
  const double all = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  count(state, gas, report.pressure.iterations);
  const double bytes = millisecondsOfBytes(cells);
  state.counters["bytes"] = bytes;
  state.counters["times"] = all / static_cast<double>(state.iterations()) / bytes;
}

void moveStep(benchmark::State& state, int cells) {
  StepBytes bytes(cells);
  for (auto _ : state) bytes.move();
  state.counters["threads"] = threadCount();
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
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
}

const bool registered = [] {
  keepFreedMemory();
  for (const int cells : {64, 128, 256}) {
    const std::string size = fmt::format("/{}/", cells);
    add("Step/DonorCell" + size + "Brisance", stepGas, cells, StepInput{DonorCell{}});
    add("Step/DonorCellHot" + size + "Brisance", stepGas, cells, StepInput{DonorCell{}, 0, true});
    add("Step/DonorCellWhirls" + size + "Brisance", stepGas, cells, StepInput{DonorCell{}, 0.5});
    add("Step/MacCormack" + size + "Brisance", stepGas, cells, StepInput{MacCormack{}});
    add("Step/Bytes" + size + "Memory", moveStep, cells);
  }
  add("Copy/Array/512M/Memory", copyArray);
  return true;
}();

}  // namespace
}  // namespace brisance
