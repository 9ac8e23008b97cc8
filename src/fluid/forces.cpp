#include "fluid/forces.h"

#include <cmath>

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

/// Brings the speeds of one component towards those of a turning cylinder.
void stirComponent(FluidState& gas, const Stirring& stirring, int component, float share) {
  Grid3<float>& speed = gas.velocity.component(component);
  const Grid3<float>& open = gas.solid.openShare.component(component);
  const Vec3d axis = normalized(stirring.axis);
  const double reach = stirring.length ? *stirring.length / 2 : HUGE_VAL;
  parallelFor(0, speed.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i) {
          const Vec3d arm = speed.position(i, j, k) - stirring.centre;
          const double along = dot(arm, axis);
          const Vec3d out = arm - axis * along;
          const bool inside = std::abs(along) <= reach && dot(out, out) <= stirring.radius * stirring.radius;
          if (!inside || !(open(i, j, k) > 0)) continue;
          const auto turning = static_cast<float>(cross(axis, out)[component] * stirring.angularSpeed);
          speed(i, j, k) += share * (turning - speed(i, j, k));
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

void stir(FluidState& gas, const FluidSettings& settings, double dt) {
  for (const Stirring& stirring : settings.stirring)
    for (int component = 0; component < 3; ++component)
      stirComponent(gas, stirring, component, static_cast<float>(1 - portableExp(-dt / stirring.relaxation)));
}

}  // namespace brisance
