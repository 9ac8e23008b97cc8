#include "fluid/forces.h"

#include "base/parallel.h"

namespace brisance {

namespace {
/// Adds acceleration(i, j, k) * dt to every open inner face along an axis.
template <class Acceleration>
void accelerate(FluidState& gas, int axis, double dt, const Acceleration& acceleration) {
  Grid3<float>& speed = gas.velocity.component(axis);
  const Grid3<float>& open = gas.solid.openShare.component(axis);
  parallelFor(0, speed.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i)
          if (open(i, j, k) > 0) speed(i, j, k) += static_cast<float>(dt * acceleration(i, j, k));
  });
}

Vec3f centreVelocity(const MacVelocity& m, int i, int j, int k) {
  const Vec3i n = m.cells();
  i = std::clamp(i, 0, n.x - 1);
  j = std::clamp(j, 0, n.y - 1);
  k = std::clamp(k, 0, n.z - 1);
  return {0.5f * (m.u(i, j, k) + m.u(i + 1, j, k)), 0.5f * (m.v(i, j, k) + m.v(i, j + 1, k)),
          0.5f * (m.w(i, j, k) + m.w(i, j, k + 1))};
}

Grid3<Vec3f> vorticity(const MacVelocity& m, const Grid3<float>& cells) {
  Grid3<Vec3f> omega(cells.size, cells.origin, cells.cellSize);
  const float scale = static_cast<float>(0.5 / cells.cellSize);
  parallelFor(0, cells.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < cells.size.y; ++j)
        for (int i = 0; i < cells.size.x; ++i) {
          const Vec3f dx = centreVelocity(m, i + 1, j, k) - centreVelocity(m, i - 1, j, k);
          const Vec3f dy = centreVelocity(m, i, j + 1, k) - centreVelocity(m, i, j - 1, k);
          const Vec3f dz = centreVelocity(m, i, j, k + 1) - centreVelocity(m, i, j, k - 1);
          omega(i, j, k) = Vec3f(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x) * scale;
        }
  });
  return omega;
}

/// N x omega at a cell; zero at the border of the box and where |omega| is flat.
Vec3f confinement(const Grid3<Vec3f>& omega, int i, int j, int k) {
  if (!omega.contains(i - 1, j - 1, k - 1) || !omega.contains(i + 1, j + 1, k + 1)) return {};
  const Vec3f gradient{length(omega(i + 1, j, k)) - length(omega(i - 1, j, k)),
                       length(omega(i, j + 1, k)) - length(omega(i, j - 1, k)),
                       length(omega(i, j, k + 1)) - length(omega(i, j, k - 1))};
  return cross(normalized(gradient), omega(i, j, k));
}
}  // namespace

void addForces(FluidState& gas, const FluidSettings& settings, double dt) {
  for (int axis = 0; axis < 3; ++axis)
    if (settings.force[axis] != 0) accelerate(gas, axis, dt, [&](int, int, int) { return settings.force[axis]; });
  if (settings.buoyancy == 0) return;
  const Grid3<float>& T = gas.temperature;
  const bool periodic = settings.faces[2] == FaceKind::periodic;
  const int last = T.size.y - 1;
  accelerate(gas, 1, dt, [&](int i, int j, int k) {
    const float below = T(i, j > 0 ? j - 1 : periodic ? last : 0, k);
    const float above = T(i, j <= last ? j : periodic ? 0 : last, k);
    return settings.buoyancy * (0.5 * (below + above) - settings.ambientTemperature);
  });
}

void confineVorticity(FluidState& gas, const FluidSettings& settings, double dt) {
  if (settings.vorticityConfinement == 0) return;
  const Grid3<Vec3f> omega = vorticity(gas.velocity, gas.temperature);
  Grid3<Vec3f> force = omega;
  parallelFor(0, omega.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < omega.size.y; ++j)
        for (int i = 0; i < omega.size.x; ++i) force(i, j, k) = confinement(omega, i, j, k);
  });
  const double strength = settings.vorticityConfinement * settings.cellSize;
  for (int axis = 0; axis < 3; ++axis)
    accelerate(gas, axis, dt, [&](int i, int j, int k) {
      const Vec3i upper{std::min(i, omega.size.x - 1), std::min(j, omega.size.y - 1), std::min(k, omega.size.z - 1)};
      Vec3i lower{i, j, k};
      lower[axis] = std::max(lower[axis] - 1, 0);
      return strength * 0.5 * (force(lower.x, lower.y, lower.z)[axis] + force(upper.x, upper.y, upper.z)[axis]);
    });
}

}  // namespace brisance
