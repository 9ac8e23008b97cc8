// A box of gas for the tests of its laws.
#pragma once

#include <gtest/gtest.h>

#include "fluid/fluid_step.h"
#include "fluid/solid_fractions.h"

namespace brisance::test {

inline Faces allFaces(FaceKind kind) { return {kind, kind, kind, kind, kind, kind}; }

inline FluidSettings box(const Vec3i& cells, FaceKind kind = FaceKind::open) {
  FluidSettings s;
  s.cells = cells;
  s.cellSize = 1.0 / cells.x;
  s.faces = allFaces(kind);
  s.coolingRate = 0;
  return s;
}

inline FluidState gasIn(const FluidSettings& s, std::span<const MovingSolid> solids = {}) {
  return makeFluid(s, stampSolids(s, solids), 1);
}

/// Value for each sample of one velocity component from a function of its place.
template <class Speed>
void setComponent(Grid3<float>& grid, const Speed& speed) {
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) grid(i, j, k) = static_cast<float>(speed(grid.position(i, j, k)));
}

/// No speed through what is closed.
inline void restAtClosedFaces(FluidState& gas) {
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n < gas.velocity.component(axis).values.size(); ++n)
      if (gas.solid.openShare.component(axis).values[n] == 0) gas.velocity.component(axis).values[n] = 0;
}

inline double largestDifference(const AlignedVector<float>& a, const AlignedVector<float>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(double(a[n]) - b[n]));
  return largest;
}

/// The grid seen in a mirror across an axis.
template <class T>
Grid3<T> mirrored(const Grid3<T>& grid, int axis) {
  Grid3<T> out = grid;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        int at[3] = {i, j, k};
        at[axis] = grid.size[axis] - 1 - at[axis];
        out(at[0], at[1], at[2]) = grid(i, j, k);
      }
  return out;
}

inline MacVelocity mirrored(const MacVelocity& velocity, int axis) {
  MacVelocity out = velocity;
  for (int a = 0; a < 3; ++a) out.component(a) = mirrored(velocity.component(a), axis);
  for (float& speed : out.component(axis).values) speed = -speed;
  return out;
}

}  // namespace brisance::test
