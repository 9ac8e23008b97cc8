#include "fluid/fluid_step.h"

#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"
#include "fluid/diffusion.h"
#include "fluid/forces.h"
#include "fluid/moving_solids.h"
#include "fluid/temperature.h"
#include "fluid/vorticity.h"

namespace brisance {

namespace {
/// Whether a value is infinite or not a number.
bool anyNotFinite(const Grid3<float>& grid) {
  constexpr std::uint32_t exponent = 0x7f800000;
  return parallelMax(grid.count(), 1 << 14, [&](std::int64_t first, std::int64_t last) {
           std::uint32_t found = 0;
           runWide([&] {
             for (std::int64_t n = first; n < last; ++n)
               found |= (std::bit_cast<std::uint32_t>(grid.values[n]) & exponent) == exponent ? 1u : 0u;
           });
           return static_cast<double>(found);
         }) > 0;
}

void addBurnt(FluidState& gas, const Burning& burning, double dt) {
  const float kept = static_cast<float>(portableExp(-dt / burning.flameLifetime));
  const float soot = static_cast<float>(burning.sootPerMass * dt), burnt = static_cast<float>(dt);
  float *soots = gas.soot.values.data(), *flames = gas.flame.values.data();
  const float* rates = gas.burnRate.values.data();
  const std::int64_t row = gas.soot.size.x;
  parallelFor(0, gas.soot.count() / row, 64, [&](std::int64_t first, std::int64_t last) {
    runWide([&] {
      for (std::int64_t begin = first * row; begin < last * row; begin += row) {
        if (!anyOther(rates + begin, row, 0) && !anyOther(flames + begin, row, 0) && !anyOther(soots + begin, row, 0))
          continue;
#pragma GCC ivdep
        for (std::int64_t n = begin; n < begin + row; ++n) {
          const float gathered = soots[n] + soot * rates[n], left = flames[n] * kept + burnt * rates[n];
          soots[n] = select(std::abs(gathered) < leastDensity, 0, gathered);
          flames[n] = select(std::abs(left) < leastDensity, 0, left);
        }
      }
    });
  });
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

/// Burn and advect, one field after the other. Returns the balance of heat.
Balance moveScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                    FluidScratch& scratch) {
  const Balance heat = stepTemperature(gas, settings, dt, scratch);
  carryScalar(gas.soot, gas, settings, 0, dt, scratch.advection, Paths::known);
  carryScalar(gas.flame, gas, settings, 0, dt, scratch.advection, Paths::known);
  addBurnt(gas, burning, dt);
  return heat;
}

void moveVelocity(FluidState& gas, const FluidSettings& settings, double dt, FluidScratch& scratch) {
  const bool asScalars = gas.solid.empty;  // else the gas beside solids has a speed of its own
  advectVelocity(gas, settings, dt, scratch.advection, asScalars ? Paths::known : Paths::toTrace);
  if (settings.viscosity > 0) diffuseVelocity(gas, settings, dt);
  addForces(gas, settings, dt);
}
}  // namespace

FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                      FluidScratch& scratch, const StepLimits& limits) {
  FluidReport report;
  report.courant = courantNumber(gas, limits, dt);
  const Burning burning{sootPerMass, settings.flameLifetime};
  const bool sweeps = sweepsSuffice(settings, report.courant);
  report.heat = sweeps ? sweepScalars(gas, settings, burning, dt, scratch.sweep, report.next.hottest)
                       : moveScalars(gas, settings, burning, dt, scratch);
  takeGasVelocity(gas);
  if (sweeps)
    sweepVelocity(gas, settings, dt, scratch.sweep);
  else
    moveVelocity(gas, settings, dt, scratch);
  confineVorticity(gas, settings, dt, scratch.sweep.velocity);
  stir(gas, settings, dt);
  takeMeanVelocity(gas);
  const Projection projection = projectAndLook(gas, settings, dt, scratch.pressure);
  report.pressure = projection.pressure;
  const FlowFindings& flow = projection.flow;
  const double h = settings.cellSize;
  report.divergence = flow.error();
  report.volume.in = dt * flow.created * h * h * h;
  report.volume.out = dt * flow.outward * h * h;
  report.next = {flow.fastest, sweeps ? report.next.hottest : largestMagnitude(gas.temperature)};
  return report;
}

StepLimits limitsOf(const FluidState& gas) { return {fastestCell(gas), largestMagnitude(gas.temperature)}; }

double courantNumber(const FluidState& gas, const StepLimits& limits, double dt) {
  return dt * std::max(limits.fastest, fastestCutCell(gas)) / gas.pressure.cellSize;
}

double longestStep(const FluidState& gas, const FluidSettings& s, double largestSource, const StepLimits& limits) {
  const double h = s.cellSize;
  double inverse = courantNumber(gas, limits, 1) / s.courant;
  inverse = std::max(inverse, largestSource / (6 * s.courant));
  const double acceleration =
      length(s.force) + std::abs(s.buoyancy) * std::max(0.0, limits.hottest - s.ambientTemperature);
  inverse = std::max(inverse, std::sqrt(acceleration / (h * s.courant)));
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
  for (const auto& [name, grid] : grids) {
    if (!anyNotFinite(*grid)) continue;
    for (std::int64_t n = 0; n < grid->count(); ++n)
      if (!std::isfinite(grid->values[n]))
        return fmt::format("{} at cell ({}, {}, {})", name, n % grid->size.x, n / grid->size.x % grid->size.y,
                           n / grid->stride(2));
  }
  return {};
}

}  // namespace brisance
