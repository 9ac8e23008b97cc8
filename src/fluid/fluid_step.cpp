#include "fluid/fluid_step.h"

#include <cmath>

#include "fluid/diffusion.h"
#include "fluid/forces.h"
#include "fluid/temperature.h"

namespace brisance {

namespace {
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
  const float ambient = static_cast<float>(s.ambientTemperature);
  Balance heat = advectScalar(gas.temperature, gas, s, ambient, dt, scratch.advection);
  heat.in *= s.heatCapacity;
  heat.out *= s.heatCapacity;
  heat += heatAndCool(gas, s, dt);
  heat.gained = heatContent(gas, s) - before;
  return heat;
}
}  // namespace

FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                      FluidScratch& scratch) {
  FluidReport report;
  report.courant = courantNumber(gas, dt);
  report.heat = stepTemperature(gas, settings, dt, scratch);
  carryScalar(gas.soot, gas, settings, 0, dt, scratch.advection);
  carryScalar(gas.flame, gas, settings, 0, dt, scratch.advection);
  addBurnt(gas, sootPerMass, settings.flameLifetime, dt);
  advectVelocity(gas, settings, dt, scratch.advection);
  if (settings.viscosity > 0) diffuseVelocity(gas, settings, dt);
  addForces(gas, settings, dt);
  confineVorticity(gas, settings, dt);
  stir(gas, settings, dt);
  report.pressure = project(gas, settings, dt, scratch.pressure);
  report.divergence = divergenceError(gas);
  report.volume.in = dt * createdVolume(gas, settings);
  report.volume.out = dt * outwardVolume(gas, settings);
  return report;
}

double longestStep(const FluidState& gas, const FluidSettings& s, double largestSource) {
  const double h = s.cellSize;
  double inverse = courantNumber(gas, 1) / s.courant;
  inverse = std::max(inverse, largestSource / (6 * s.courant));
  const double hottest = largestMagnitude(gas.temperature) - s.ambientTemperature;
  const double acceleration = length(s.force) + std::abs(s.buoyancy) * std::max(0.0, hottest);
  inverse = std::max(inverse, std::sqrt(acceleration / (h * s.courant)));
  return inverse > 0 ? 1 / inverse : HUGE_VAL;
}

std::string findNotFinite(const FluidState& gas) {
  const std::pair<const char*, const Grid3<float>*> grids[] = {
      {"velocity u", &gas.velocity.u}, {"velocity v", &gas.velocity.v},   {"velocity w", &gas.velocity.w},
      {"pressure", &gas.pressure},     {"temperature", &gas.temperature}, {"soot", &gas.soot}};
  for (const auto& [name, grid] : grids)
    for (std::int64_t n = 0; n < grid->count(); ++n)
      if (!std::isfinite(grid->values[n]))
        return fmt::format("{} at cell ({}, {}, {})", name, n % grid->size.x, n / grid->size.x % grid->size.y,
                           n / grid->stride(2));
  return {};
}

}  // namespace brisance
