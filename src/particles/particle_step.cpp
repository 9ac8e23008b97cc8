#include "particles/particle_step.h"

#include <cmath>

#include "base/parallel.h"
#include "grid/interpolate.h"

namespace brisance {

namespace {
/// log(1 + x) / x for x >= 0
double logRatio(double x) { return x < 1e-4 ? 1 - x / 2 + x * x / 3 : portableLog(1 + x) / x; }

/// The place that `from` reaches on its way to `to`, one axis after the other, stopping short of closed faces:
/// particles slide along walls. False when it leaves the box.
bool moveThrough(const MacVelocity& openShare, const Vec3d& from, const Vec3d& to, Vec3d& reached) {
  const Vec3i cells = openShare.cells();
  const double h = openShare.u.cellSize;
  const Vec3d corner = openShare.u.origin - Vec3d(0, .5, .5) * h;
  constexpr double justShort = 1e-6;  // of a cell
  Vec3d p = (from - corner) / h;
  const Vec3d goal = (to - corner) / h;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& open = openShare.component(axis);
    int cell[3] = {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
    const bool forward = goal[axis] > p[axis];
    double end = goal[axis];
    while (forward ? cell[axis] + 1 <= end : cell[axis] > end) {
      const int face = cell[axis] + (forward ? 1 : 0);
      int at[3] = {cell[0], cell[1], cell[2]};
      at[axis] = face;
      if (open(at[0], at[1], at[2]) == 0) {
        end = face + (forward ? -justShort : justShort);
        break;
      }
      cell[axis] += forward ? 1 : -1;
      if (cell[axis] < 0 || cell[axis] >= cells[axis]) return false;
    }
    p[axis] = end;
  }
  reached = corner + p * h;
  for (int axis = 0; axis < 3; ++axis)
    if (!(p[axis] >= 0 && p[axis] < cells[axis])) return false;
  return true;
}
}  // namespace

Dragged dragExactly(const Vec3d& velocity, const Vec3d& gas, double k, double dt) {
  // With d = g - v: d' = -k |d| d, so |d| = |d0| / (1 + k |d0| t) and its integral is d0 log(1 + k |d0| t) / (k |d0|).
  const Vec3d difference = gas - velocity;
  const double x = k * length(difference) * dt;
  return {gas * dt - difference * (dt * logRatio(x)), gas - difference * (1 / (1 + x))};
}

void stepParticles(ParticleSet& p, const GasAround& gas, const BurnSettings& settings, double dt) {
  std::vector<std::uint8_t> gone(p.size());
  const double r2 = settings.radius * settings.radius;
  const bool heats = settings.thermalMass >= settings.thermalMassThreshold;
  const double kept = heats ? portableExp(-dt * settings.heating * r2 / settings.thermalMass) : 0;  // of the difference
  parallelFor(0, static_cast<std::int64_t>(p.size()), 512, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      const double threshold =
          p.kind[n] == ParticleKind::fuel ? settings.fuelMassThreshold : settings.sootMassThreshold;
      const Vec3d wind = interpolate(gas.velocity, p.position[n]);
      const Dragged step = p.mass[n] < threshold ? Dragged{wind * dt, wind}
                                                 : dragExactly(p.velocity[n], wind, settings.drag * r2 / p.mass[n], dt);
      p.velocity[n] = step.velocity;
      const Vec3d goal = p.position[n] + step.displacement;
      gone[n] = !moveThrough(gas.openShare, p.position[n], goal, p.position[n]);
      if (gone[n]) continue;
      const double around = interpolate(gas.temperature, p.position[n]);
      p.temperature[n] = around + (p.temperature[n] - around) * kept;
    }
  });
  removeFlagged(p, gone);
}

}  // namespace brisance
