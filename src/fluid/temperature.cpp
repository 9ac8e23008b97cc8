#include "fluid/temperature.h"

#include <cmath>

#include "base/parallel.h"
#include "fluid/diffusion.h"

namespace brisance {

namespace {
/// Sum over cells that are not solid of a function of the cell's number.
template <class Term>
double cellSum(const FluidState& gas, const Term& term) {
  const auto& solid = gas.solid.inside.values;
  return parallelSum(static_cast<std::int64_t>(solid.size()), 4096, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (std::int64_t n = first; n < last; ++n)
      if (!solid[n]) sum += term(n);
    return sum;
  });
}
}  // namespace

double cooled(double theta, double range, double rate, double dt) {
  if (theta <= 0) return theta;
  const double x = theta / range;
  // (the C library has one cbrt for all processors, unlike exp and log)
  // d x/dt = -(rate / range) x^4 gives 1/x^3 = 1/x0^3 + 3 (rate / range) t.
  return theta / std::cbrt(1 + 3 * (rate / range) * x * x * x * dt);
}

Balance heatAndCool(FluidState& gas, const FluidSettings& settings, double dt) {
  if (settings.conductivity > 0) conduct(gas, settings, dt);
  const double ambient = settings.ambientTemperature, range = settings.maximumTemperature - ambient;
  auto& T = gas.temperature.values;
  const double heated = cellSum(gas, [&](std::int64_t n) {
    const float before = T[n];
    T[n] = static_cast<float>(before + dt * gas.heatRate.values[n]);
    return dt * gas.heatRate.values[n];
  });
  const double radiated = cellSum(gas, [&](std::int64_t n) {
    const double before = T[n];
    T[n] = static_cast<float>(ambient + cooled(before - ambient, range, settings.coolingRate, dt));
    return before - T[n];
  });
  const double perKelvin = settings.heatCapacity * settings.cellSize * settings.cellSize * settings.cellSize;
  Balance balance;
  balance.in = heated * perKelvin;
  balance.lost = radiated * perKelvin;
  return balance;
}

double heatContent(const FluidState& gas, const FluidSettings& settings) {
  const double sum =
      cellSum(gas, [&](std::int64_t n) { return gas.temperature.values[n] - settings.ambientTemperature; });
  return sum * settings.heatCapacity * settings.cellSize * settings.cellSize * settings.cellSize;
}

}  // namespace brisance
