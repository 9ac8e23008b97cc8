#include "fluid/fluid_state.h"

#include "base/random.h"

namespace brisance {

namespace {
/// The wind, with small random velocities so that the explosion is not symmetric (thesis 2.4.3). What is closed of a
/// face stays at rest.
void stir(FluidState& gas, const Vec3d& wind, double deviation, std::uint64_t seed) {
  const Random random(seed, Stream::startVelocity);
  std::uint64_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    auto& values = gas.velocity.component(axis).values;
    const auto& open = gas.solid.openShare.component(axis).values;
    for (std::size_t n = 0; n < values.size(); ++n)
      values[n] = open[n] * static_cast<float>(wind[axis] + deviation * random.normal(index + n));
    index += values.size();
  }
}
/// The two faces of a periodic box at which an axis begins again are one.
void joinPeriodicFaces(MacVelocity& velocity, const Faces& faces) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!isPeriodic(faces, axis)) continue;
    Grid3<float>& speed = velocity.component(axis);
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i) {
          Vec3i from{i, j, k};
          if (from[axis] + 1 < speed.size[axis]) continue;
          from[axis] = 0;
          speed(i, j, k) = speed(from.x, from.y, from.z);
        }
  }
}
}  // namespace

FluidState makeFluid(const FluidSettings& settings, const SolidStamp& solid, std::uint64_t seed) {
  FluidState gas;
  gas.velocity = MacVelocity(settings.cells, settings.corner, settings.cellSize);
  const auto zeros = cellGrid(settings, 0.0f);
  gas.pressure = gas.soot = gas.flame = gas.divergence = gas.heatRate = gas.burnRate = zeros;
  gas.temperature = cellGrid(settings, static_cast<float>(settings.ambientTemperature));
  gas.solid = solid;
  if (settings.startVelocity > 0 || !(settings.wind == Vec3d{})) stir(gas, settings.wind, settings.startVelocity, seed);
  joinPeriodicFaces(gas.velocity, settings.faces);
  return gas;
}

}  // namespace brisance
