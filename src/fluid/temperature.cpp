#include "fluid/temperature.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"
#include "fluid/cooling.h"
#include "fluid/diffusion.h"

namespace brisance {

double cooled(double theta, double range, double rate, double dt) {
  if (theta <= 0) return theta;
  const double x = theta / range;
  // (the C library has one cbrt for all processors, unlike exp and log)
  // d x/dt = -(rate / range) x^4 gives 1/x^3 = 1/x0^3 + 3 (rate / range) t.
  return theta / std::cbrt(1 + 3 * (rate / range) * x * x * x * dt);
}

Balance heatAndCool(FluidState& gas, const FluidSettings& settings, double dt) {
  if (settings.conductivity > 0) conduct(gas, settings, dt);
  const HeatRow heatRow(settings, dt);
  const float ambient = static_cast<float>(settings.ambientTemperature);
  const Vec3i n = gas.temperature.size;
  std::vector<HeatRow::Sums> planes(n.z);
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    std::vector<float> room(n.x);
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j)
        runWide([&] {
          if (!anyOther(&gas.temperature(0, j, k), n.x, ambient) && !anyOther(&gas.heatRate(0, j, k), n.x, 0)) return;
          const auto sums =
              heatRow(&gas.temperature(0, j, k), &gas.heatRate(0, j, k), &gas.solid.inside(0, j, k), n.x, room.data());
          planes[k].heated += sums.heated;
          planes[k].radiated += sums.radiated;
        });
  });
  const double perKelvin = settings.heatCapacity * settings.cellSize * settings.cellSize * settings.cellSize;
  Balance balance;
  for (const HeatRow::Sums& plane : planes) {
    balance.in += plane.heated * perKelvin;
    balance.lost += plane.radiated * perKelvin;
  }
  return balance;
}

double heatContent(const FluidState& gas, const FluidSettings& settings) {
  const float ambient = static_cast<float>(settings.ambientTemperature);
  const std::uint8_t* inside = gas.solid.inside.values.data();
  const float* T = gas.temperature.values.data();
  const double sum = parallelSum(gas.temperature.count(), 1 << 14, [&](std::int64_t first, std::int64_t last) {
    double part = 0;
    runWide([&] {
      constexpr std::int64_t atOnce = 1 << 10;  // of which most are as the air around
      for (std::int64_t begin = first; begin < last; begin += atOnce) {
        const std::int64_t count = std::min(atOnce, last - begin);
        if (anyOther(T + begin, count, ambient))
          part += laneSum(count, [&](std::int64_t n) { return inside[begin + n] ? 0 : T[begin + n] - ambient; });
      }
    });
    return part;
  });
  return sum * settings.heatCapacity * settings.cellSize * settings.cellSize * settings.cellSize;
}

}  // namespace brisance
