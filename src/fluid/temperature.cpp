#include "fluid/temperature.h"

#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/cooling.h"

namespace brisance {

namespace {
/// c_k times the Laplacian, through open inner faces only: Neumann at the box (thesis 2.4.3) and at solids. Around a
/// periodic box.
void conduct(FluidState& gas, const FluidSettings& settings, double dt, Grid3<float>& scratch) {
  scratch = gas.temperature;
  const Grid3<float>& T = scratch;
  const float share = static_cast<float>(settings.conductivity * dt / (settings.cellSize * settings.cellSize));
  parallelFor(0, T.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < T.size.y; ++j)
        for (int i = 0; i < T.size.x; ++i) {
          const std::int64_t here = T.index(i, j, k);
          const int place[3] = {i, j, k};
          float sum = 0;
          for (int axis = 0; axis < 3; ++axis) {
            const Grid3<float>& open = gas.solid.openShare.component(axis);
            const std::int64_t face = open.index(i, j, k), step = T.stride(axis);
            const bool periodic = settings.faces[2 * axis] == FaceKind::periodic;
            const std::int64_t around = step * (T.size[axis] - 1);
            const bool atLower = place[axis] == 0, atUpper = place[axis] + 1 == T.size[axis];
            if (!atLower || periodic)
              sum += open.values[face] * (T.values[atLower ? here + around : here - step] - T.values[here]);
            if (!atUpper || periodic)
              sum += open.values[face + open.stride(axis)] *
                     (T.values[atUpper ? here - around : here + step] - T.values[here]);
          }
          gas.temperature.values[here] += share * sum;
        }
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

Balance heatAndCool(FluidState& gas, const FluidSettings& settings, double dt, Grid3<float>& scratch) {
  if (settings.conductivity > 0) conduct(gas, settings, dt, scratch);
  const HeatRow heatRow(settings, dt);
  const Vec3i n = gas.temperature.size;
  std::vector<HeatRow::Sums> planes(n.z);
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    std::vector<float> room(n.x);
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j)
        runWide([&] {
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
      part = laneSum(last - first, [&](std::int64_t n) { return inside[first + n] ? 0 : T[first + n] - ambient; });
    });
    return part;
  });
  return sum * settings.heatCapacity * settings.cellSize * settings.cellSize * settings.cellSize;
}

}  // namespace brisance
