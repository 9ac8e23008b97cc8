#include "fluid/fluid_step.h"

#include <cmath>

#include "base/parallel.h"
#include "fluid/forces.h"
#include "fluid/moving_solids.h"
#include "fluid/temperature.h"

namespace brisance {

namespace {
double largestMagnitude(const Grid3<float>& grid) {
  return parallelMax(grid.count(), 1 << 14, [&](std::int64_t first, std::int64_t last) {
    float largest = 0;
    for (std::int64_t n = first; n < last; ++n) largest = std::max(largest, std::abs(grid.values[n]));
    return static_cast<double>(largest);
  });
}

void addBurnt(FluidState& gas, double sootPerMass, double flameLifetime, double dt) {
  const float kept = static_cast<float>(portableExp(-dt / flameLifetime));
  for (std::size_t n = 0; n < gas.soot.values.size(); ++n) {
    const double burnt = dt * gas.burnRate.values[n];
    gas.soot.values[n] += static_cast<float>(sootPerMass * burnt);
    gas.flame.values[n] = gas.flame.values[n] * kept + static_cast<float>(burnt);
  }
}

/// Heat carried, released, cooled: the balance of the whole step.
Balance stepTemperature(FluidState& gas, const FluidSettings& s, double dt, FluidScratch& scratch) {
  const double before = heatContent(gas, s);
  Balance heat = advectScalar(gas.temperature, gas, s, static_cast<float>(s.ambientTemperature), dt, scratch.advection);
  heat.in *= s.heatCapacity;
  heat.out *= s.heatCapacity;
  heat += heatAndCool(gas, s, dt, scratch.temperature);
  heat.gained = heatContent(gas, s) - before;
  return heat;
}
}  // namespace

FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                      FluidScratch& scratch) {
  FluidReport report;
  report.courant = courantNumber(gas, dt);
  report.heat = stepTemperature(gas, settings, dt, scratch);
  advectScalar(gas.soot, gas, settings, 0, dt, scratch.advection);
  advectScalar(gas.flame, gas, settings, 0, dt, scratch.advection);
  addBurnt(gas, sootPerMass, settings.flameLifetime, dt);
  takeGasVelocity(gas);
  advectVelocity(gas, settings, dt, scratch.advection);
  addForces(gas, settings, dt);
  confineVorticity(gas, settings, dt);
  takeMeanVelocity(gas);
  report.pressure = project(gas, settings, dt, scratch.pressure);
  report.divergence = divergenceError(gas);
  report.volume.in = dt * createdVolume(gas, settings);
  report.volume.out = dt * outwardVolume(gas, settings);
  return report;
}

double courantNumber(const FluidState& gas, double dt) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += largestMagnitude(gas.velocity.component(axis));
  return dt * sum / gas.pressure.cellSize;
}

double longestStep(const FluidState& gas, const FluidSettings& s, double largestSource) {
  const double h = s.cellSize;
  double inverse = courantNumber(gas, 1) / s.courant;
  inverse = std::max(inverse, largestSource / (6 * s.courant));
  const double hottest = largestMagnitude(gas.temperature) - s.ambientTemperature;
  const double acceleration = length(s.force) + std::abs(s.buoyancy) * std::max(0.0, hottest);
  inverse = std::max(inverse, std::sqrt(acceleration / (h * s.courant)));
  const double diffusion = std::max(s.viscosity, s.conductivity);
  inverse = std::max(inverse, 6 * diffusion / (h * h));
  return inverse > 0 ? 1 / inverse : HUGE_VAL;
}

std::string findNotFinite(const FluidState& gas) {
  const std::pair<const char*, const Grid3<float>*> grids[] = {{"velocity u", &gas.velocity.u},
                                                               {"velocity v", &gas.velocity.v},
                                                               {"velocity w", &gas.velocity.w},
                                                               {"pressure", &gas.pressure},
                                                               {"temperature", &gas.temperature},
                                                               {"soot", &gas.soot},
                                                               {"flame", &gas.flame}};
  for (const auto& [name, grid] : grids)
    for (std::int64_t n = 0; n < grid->count(); ++n)
      if (!std::isfinite(grid->values[n]))
        return fmt::format("{} at cell ({}, {}, {})", name, n % grid->size.x, n / grid->size.x % grid->size.y,
                           n / grid->stride(2));
  return {};
}

}  // namespace brisance
