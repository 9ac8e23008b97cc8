#include "simulation/coupling.h"

#include "particles/burning.h"
#include "particles/particle_step.h"

namespace brisance {

void burnIntoGas(WorldState& world, const SimulationSettings& settings, double dt) {
  const BurnSettings& burning = settings.particles.burning;
  FluidState& gas = world.gas;
  const std::vector<double> burnt = burn(world.particles, burning, dt);
  std::fill(gas.burnRate.values.begin(), gas.burnRate.values.end(), 0.0f);
  depositBurnt(world.particles, burnt, burning, dt, gas.solid.inside, gas.burnRate);
  const float heat = static_cast<float>(burning.heatPerMass / settings.fluid.heatCapacity);
  const float expansion = static_cast<float>(burning.gasPerMass);
  world.largestSource = 0;
  for (std::size_t n = 0; n < gas.burnRate.values.size(); ++n) {
    gas.heatRate.values[n] = heat * gas.burnRate.values[n];
    gas.divergence.values[n] = expansion * gas.burnRate.values[n];
    world.largestSource = std::max(world.largestSource, static_cast<double>(gas.divergence.values[n]));
  }
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
