// A million burning particles: what a sub-step of the simulation does with them. The deviation from exact sums is
// recomputed in double precision from the result.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/random.h"
#include "particles/burning.h"
#include "particles/deposit.h"
#include "particles/particle_order.h"
#include "particles/particle_step.h"

namespace brisance {
namespace {

constexpr int cells = 128;        // along each side of a box of 1 m
constexpr int count = 1'000'000;  // particles
constexpr double cellSize = 1.0 / cells, fireRadius = 0.3;

/// Gas that turns and expands, one cell in a sub-step where it is fastest.
struct Gas {
  MacVelocity velocity{{cells, cells, cells}, {0, 0, 0}, cellSize};
  MacVelocity open = velocity;
  Grid3<float> temperature{{cells, cells, cells}, Vec3d(.5, .5, .5) * cellSize, cellSize, 1500.f};
  Grid3<std::uint8_t> solid{{cells, cells, cells}, Vec3d(.5, .5, .5) * cellSize, cellSize, 0};
  Grid3<float> rate = temperature;
  bool bodies = false;  ///< whether each face is looked at

  Gas() {
    for (int axis = 0; axis < 3; ++axis) {
      std::fill(open.component(axis).values.begin(), open.component(axis).values.end(), 1.f);
      Grid3<float>& component = velocity.component(axis);
      for (int k = 0; k < component.size.z; ++k)
        for (int j = 0; j < component.size.y; ++j)
          for (int i = 0; i < component.size.x; ++i) {
            const Vec3d away = component.position(i, j, k) - Vec3d(.5, .5, .5);
            component(i, j, k) = static_cast<float>((cross(Vec3d(0, 3, 0), away) + away * 3.0)[axis]);
          }
    }
  }
  GasAround around() const { return {velocity, temperature, open, {}, !bodies}; }
};

constexpr double dt = 0.0025;  // [s]

/// As much fuel as the calibrated explosion of a thousand particles has, in a million.
BurnSettings fineFuel(bool makesSoot) {
  BurnSettings s;
  constexpr double finer = 1e-3;
  s.mass *= finer;
  s.burnRate *= finer;
  s.sootThreshold *= makesSoot ? finer : 1;
  s.fuelMassThreshold *= finer;
  s.sootMassThreshold *= finer;
  s.radius *= std::sqrt(finer);  // the same drag and heating per mass
  s.thermalMass *= finer;
  return s;
}

/// In a ball, all alight, some of them nearly burnt.
ParticleSet burningBall(const BurnSettings& settings) {
  ParticleSet particles;
  const Random random(1, Stream::test);
  for (std::uint64_t n = 0; n < count; ++n) {
    NewParticle fuel;
    fuel.position = Vec3d(.5, .5, .5) + random.onSphere(n) * (fireRadius * std::cbrt(random.uniform(4 * n)));
    fuel.mass = settings.mass * (0.01 + random.uniform(4 * n + 1));
    fuel.temperature = 1200;
    fuel.ignited = true;
    append(particles, fuel);
    particles.sootMass.back() = settings.sootThreshold * random.uniform(4 * n + 2);  // some are about to make soot
  }
  return particles;
}

double massOf(const Grid3<float>& rate) {
  double sum = 0;
  for (const float r : rate.values) sum += r;
  return sum * cellSize * cellSize * cellSize * dt;
}

/// burn, deposit, (soot,) remove what is spent, carry, heat and ignite: `sort` first, as once in a frame.
void burnParticles(benchmark::State& state, bool sort, bool makesSoot) {
  const BurnSettings settings = fineFuel(makesSoot);
  Gas gas;
  DepositScratch scratch;
  OrderScratch order;
  std::vector<double> burnt;
  ParticleSet start = burningBall(settings);
  if (!sort) sortByRow(start, gas.rate, order);
  ParticleSet particles = start;
  const auto subStep = [&] {
    if (sort) sortByRow(particles, gas.rate, order);
    burn(particles, settings, dt, burnt);
    depositBurnt(particles, burnt, settings, dt, gas.solid, gas.rate, scratch);
    if (makesSoot) createSoot(particles, settings, gas.solid, 1);
    removeSpent(particles, settings, dt);
    stepParticles(particles, gas.around(), settings, dt);
  };
  subStep();  // fresh memory comes once in a film
  for (auto _ : state) {
    state.PauseTiming();
    particles = start;
    state.ResumeTiming();
    subStep();
  }
  double total = 0;
  for (const double mass : burnt) total += mass;
  state.counters["threads"] = threadCount();
  state.counters["heatError"] = std::abs(massOf(gas.rate) / total - 1);
  state.counters["particlesAfter"] = static_cast<double>(particles.size());
}

/// One part of it.
void depositParticles(benchmark::State& state) {
  const BurnSettings settings = fineFuel(false);
  Gas gas;
  DepositScratch scratch;
  OrderScratch order;
  std::vector<double> burnt;
  ParticleSet particles = burningBall(settings);
  sortByRow(particles, gas.rate, order);
  burn(particles, settings, dt, burnt);
  depositBurnt(particles, burnt, settings, dt, gas.solid, gas.rate, scratch);
  for (auto _ : state) depositBurnt(particles, burnt, settings, dt, gas.solid, gas.rate, scratch);
  state.counters["threads"] = threadCount();
}

void carryParticles(benchmark::State& state, bool bodies) {
  const BurnSettings settings = fineFuel(false);
  Gas gas;
  gas.bodies = bodies;
  OrderScratch order;
  ParticleSet start = burningBall(settings);
  sortByRow(start, gas.rate, order);
  ParticleSet particles = start;
  for (auto _ : state) {
    state.PauseTiming();
    particles = start;
    state.ResumeTiming();
    stepParticles(particles, gas.around(), settings, dt);
  }
  state.counters["threads"] = threadCount();
}

template <class... Arguments>
void add(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
}

const bool registered = [] {
  keepFreedMemory();
  add("Particles/Burning/1M/Brisance", burnParticles, false, false);
  add("Particles/BurningAndSorting/1M/Brisance", burnParticles, true, false);
  add("Particles/BurningWithSoot/1M/Brisance", burnParticles, false, true);
  add("Particles/Deposit/1M/Brisance", depositParticles);
  add("Particles/Carry/1M/Brisance", carryParticles, false);
  add("Particles/CarryAmongBodies/1M/Brisance", carryParticles, true);
  return true;
}();

}  // namespace
}  // namespace brisance
