#include "fluid/forces.h"

#include <cmath>

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

/// The cell of a number along an axis: the nearest inside, or around a periodic box.
int cellAlong(int i, int count, bool periodic) {
  if (!periodic) return std::clamp(i, 0, count - 1);
  return i < 0 ? i + count : i >= count ? i - count : i;
}

/// Cells around a cell.
class Neighbours {
 public:
  Neighbours(const Vec3i& cells, const Faces& faces) : cells_(cells) {
    for (int axis = 0; axis < 3; ++axis) periodic_[axis] = faces[2 * axis] == FaceKind::periodic;
  }
  Vec3i at(int i, int j, int k) const {
    return {cellAlong(i, cells_.x, periodic_[0]), cellAlong(j, cells_.y, periodic_[1]),
            cellAlong(k, cells_.z, periodic_[2])};
  }
  /// Whether all six lie in the box, or around it.
  bool surround(int i, int j, int k) const {
    const auto inside = [&](int at, int axis) { return periodic_[axis] || (at > 0 && at + 1 < cells_[axis]); };
    return inside(i, 0) && inside(j, 1) && inside(k, 2);
  }

 private:
  Vec3i cells_;
  bool periodic_[3];
};

Vec3f centreVelocity(const MacVelocity& m, const Vec3i& c) {
  return {0.5f * (m.u(c.x, c.y, c.z) + m.u(c.x + 1, c.y, c.z)), 0.5f * (m.v(c.x, c.y, c.z) + m.v(c.x, c.y + 1, c.z)),
          0.5f * (m.w(c.x, c.y, c.z) + m.w(c.x, c.y, c.z + 1))};
}

Grid3<Vec3f> vorticity(const MacVelocity& m, const Grid3<float>& cells, const Neighbours& cell) {
  Grid3<Vec3f> omega(cells.size, cells.origin, cells.cellSize);
  const float scale = static_cast<float>(0.5 / cells.cellSize);
  parallelFor(0, cells.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < cells.size.y; ++j)
        for (int i = 0; i < cells.size.x; ++i) {
          const Vec3f dx = centreVelocity(m, cell.at(i + 1, j, k)) - centreVelocity(m, cell.at(i - 1, j, k));
          const Vec3f dy = centreVelocity(m, cell.at(i, j + 1, k)) - centreVelocity(m, cell.at(i, j - 1, k));
          const Vec3f dz = centreVelocity(m, cell.at(i, j, k + 1)) - centreVelocity(m, cell.at(i, j, k - 1));
          omega(i, j, k) = Vec3f(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x) * scale;
        }
  });
  return omega;
}

/// N x omega at a cell; zero at the walls and open faces of the box and where |omega| is flat.
Vec3f confinement(const Grid3<Vec3f>& omega, const Neighbours& cell, int i, int j, int k) {
  if (!cell.surround(i, j, k)) return {};
  const auto strength = [&](int ii, int jj, int kk) {
    const Vec3i c = cell.at(ii, jj, kk);
    return length(omega(c.x, c.y, c.z));
  };
  const Vec3f gradient{strength(i + 1, j, k) - strength(i - 1, j, k), strength(i, j + 1, k) - strength(i, j - 1, k),
                       strength(i, j, k + 1) - strength(i, j, k - 1)};
  return cross(normalized(gradient), omega(i, j, k));
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
          if (!(open(i, j, k) > 0) || std::abs(along) > reach || dot(out, out) > stirring.radius * stirring.radius)
            continue;
          const auto turning = static_cast<float>(cross(axis, out)[component] * stirring.angularSpeed);
          speed(i, j, k) += share * (turning - speed(i, j, k));
        }
  });
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
  const Neighbours cell(gas.temperature.size, settings.faces);
  const Grid3<Vec3f> omega = vorticity(gas.velocity, gas.temperature, cell);
  Grid3<Vec3f> force = omega;
  parallelFor(0, omega.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < omega.size.y; ++j)
        for (int i = 0; i < omega.size.x; ++i) force(i, j, k) = confinement(omega, cell, i, j, k);
  });
  const double strength = settings.vorticityConfinement * settings.cellSize;
  for (int axis = 0; axis < 3; ++axis)
    accelerate(gas, axis, dt, [&](int i, int j, int k) {
      const Vec3i upper = cell.at(i, j, k);
      const Vec3i lower = cell.at(i - (axis == 0), j - (axis == 1), k - (axis == 2));
      return strength * 0.5 * (force(lower.x, lower.y, lower.z)[axis] + force(upper.x, upper.y, upper.z)[axis]);
    });
}

void stir(FluidState& gas, const FluidSettings& settings, double dt) {
  for (const Stirring& stirring : settings.stirring)
    for (int component = 0; component < 3; ++component)
      stirComponent(gas, stirring, component, static_cast<float>(1 - portableExp(-dt / stirring.relaxation)));
}

}  // namespace brisance
