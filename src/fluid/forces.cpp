#include "fluid/forces.h"

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
/// Adds the gain(i) that gainOf(j, k) makes for a row to every open face along an axis.
template <class GainOf>
void accelerate(FluidState& gas, int axis, const GainOf& gainOf) {
  Grid3<float>& speed = gas.velocity.component(axis);
  const Grid3<float>& open = gas.solid.openShare.component(axis);
  parallelFor(0, speed.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < speed.size.y; ++j) {
        const auto gain = gainOf(j, k);
        float* row = &speed(0, j, k);
        const float* share = &open(0, j, k);
        runWide([&] {
#pragma GCC ivdep
          for (int i = 0; i < speed.size.x; ++i) row[i] = share[i] > 0 ? row[i] + gain(i) : row[i];
        });
      }
  });
}
}  // namespace

Lift::Lift(const Grid3<float>& T, const FluidSettings& settings, double dt, int j, int k)
    : perKelvin(static_cast<float>(dt * settings.buoyancy)), ambient(static_cast<float>(settings.ambientTemperature)) {
  const int last = T.size.y - 1;
  const bool periodic = settings.faces[2] == FaceKind::periodic;
  below = &T(0, j > 0 ? j - 1 : periodic ? last : 0, k);
  above = &T(0, j <= last ? j : periodic ? 0 : last, k);
}

void addForces(FluidState& gas, const FluidSettings& settings, double dt) {
  for (int axis = 0; axis < 3; ++axis) {
    const float gained = static_cast<float>(dt * settings.force[axis]);
    if (gained != 0) accelerate(gas, axis, [&](int, int) { return [gained](int) { return gained; }; });
  }
  if (settings.buoyancy == 0) return;
  accelerate(gas, 1, [&](int j, int k) { return Lift(gas.temperature, settings, dt, j, k); });
}

}  // namespace brisance
