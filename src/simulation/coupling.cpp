#include "simulation/coupling.h"

#include "base/parallel.h"
#include "base/vector_path.h"
#include "particles/burning.h"
#include "particles/particle_step.h"

namespace brisance {

namespace {
/// Heat and expansion follow the fuel burnt; the largest expansion [1/s].
double spreadBurning(FluidState& gas, float heat, float expansion) {
  constexpr std::int64_t blockSize = 1 << 16;
  return parallelMax(gas.burnRate.count(), blockSize, [&](std::int64_t first, std::int64_t last) {
    float largest = 0;
    runWide([&] {
      for (std::int64_t n = first; n < last; ++n) {
        const float burning = gas.burnRate.values[n];
        gas.heatRate.values[n] = heat * burning;
        gas.divergence.values[n] = expansion * burning;
        largest = std::max(largest, expansion * burning);
      }
    });
    return static_cast<double>(largest);
  });
}
}  // namespace

void burnIntoGas(WorldState& world, const SimulationSettings& settings, double dt) {
  const BurnSettings& burning = settings.particles.burning;
  FluidState& gas = world.gas;
  burn(world.particles, burning, dt, world.burnt);
  depositBurnt(world.particles, world.burnt, burning, dt, gas.solid.inside, gas.burnRate, world.deposit);
  world.largestSource = spreadBurning(gas, static_cast<float>(burning.heatPerMass / settings.fluid.heatCapacity),
                                      static_cast<float>(burning.gasPerMass));
  world.burning = countBurning(world.particles);
  createSoot(world.particles, burning, gas.solid.inside, settings.seed);
  removeSpent(world.particles, burning, dt);
}

void carryParticles(WorldState& world, const SimulationSettings& settings, double dt) {
  const GasAround around{world.gas.velocity, world.gas.temperature, world.gas.solid.openShare};
  stepParticles(world.particles, around, settings.particles.burning, dt);
  ignite(world.particles, settings.particles.burning);
}

double expectedSource(const WorldState& world, const SimulationSettings& settings) {
  const std::size_t burning = countBurning(world.particles);
  if (burning == 0) return 0;
  const BurnSettings& b = settings.particles.burning;
  const double stacked = b.gasPerMass * largestDeposit(burning, b, settings.fluid.cellSize);
  if (world.burning == 0) return stacked;
  const double growth = static_cast<double>(burning) / static_cast<double>(world.burning);
  return std::min(stacked, world.largestSource * std::max(1.0, growth));
}

}  // namespace brisance
