// Numbers on a lattice: one value per cell of a box of cubic cells.
#pragma once

#include <cstdint>

#include "base/aligned.h"
#include "base/check.h"
#include "base/math.h"

namespace brisance {

/// Values at `origin + (i, j, k) * cellSize`, i running fastest. `origin` is the place of sample (0, 0, 0), so a grid
/// of cell centres and one of faces differ in their origins and sizes alone.
template <class T>
struct Grid3 {
  Vec3i size;
  Vec3d origin;         ///< [m] of sample (0, 0, 0)
  double cellSize = 1;  ///< [m]
  AlignedVector<T> values;

  Grid3() = default;
  Grid3(const Vec3i& size_, const Vec3d& origin_, double cellSize_, T value = T{})
      : size(size_),
        origin(origin_),
        cellSize(cellSize_),
        values(static_cast<std::size_t>(size_.x) * size_.y * size_.z, value) {}

  std::int64_t index(int i, int j, int k) const {
    return i + static_cast<std::int64_t>(size.x) * (j + static_cast<std::int64_t>(size.y) * k);
  }
  T& operator()(int i, int j, int k) { return values[index(i, j, k)]; }
  const T& operator()(int i, int j, int k) const { return values[index(i, j, k)]; }
  std::int64_t count() const { return static_cast<std::int64_t>(values.size()); }
  /// Step of `index` along an axis.
  std::int64_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size.x : static_cast<std::int64_t>(size.x) * size.y;
  }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size.x && j < size.y && k < size.z;
  }
  Vec3d position(int i, int j, int k) const { return origin + Vec3d(i, j, k) * cellSize; }

  friend bool operator==(const Grid3&, const Grid3&) = default;
};

}  // namespace brisance
