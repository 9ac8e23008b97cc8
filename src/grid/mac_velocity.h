// Velocity on the faces of cells (Harlow & Welch 1965): u(i,j,k) on the face between cells i-1 and i, positive towards
// +x.
#pragma once

#include <array>

#include "grid/grid3.h"

namespace brisance {

struct MacVelocity {
  Grid3<float> u, v, w;  ///< [m/s]; sizes n + 1 along their own axis

  MacVelocity() = default;
  /// `cells` cells of `cellSize`, the box's lower corner at `corner`.
  MacVelocity(const Vec3i& cells, const Vec3d& corner, double cellSize)
      : u({cells.x + 1, cells.y, cells.z}, corner + Vec3d(0, .5, .5) * cellSize, cellSize),
        v({cells.x, cells.y + 1, cells.z}, corner + Vec3d(.5, 0, .5) * cellSize, cellSize),
        w({cells.x, cells.y, cells.z + 1}, corner + Vec3d(.5, .5, 0) * cellSize, cellSize) {}

  Vec3i cells() const { return {u.size.x - 1, u.size.y, u.size.z}; }
  Grid3<float>& component(int axis) { return axis == 0 ? u : axis == 1 ? v : w; }
  const Grid3<float>& component(int axis) const { return axis == 0 ? u : axis == 1 ? v : w; }
  friend bool operator==(const MacVelocity&, const MacVelocity&) = default;
};

}  // namespace brisance
