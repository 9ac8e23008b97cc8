// The way of a particle from cell to cell, through open faces alone.
#pragma once

#include <cmath>

#include "grid/interpolate_many.h"
#include "particles/particle_step.h"

namespace brisance {

/// The cells of some places, -1 or the number of cells along an axis in which they lie outside the box.
struct CellBlock {
  std::int32_t along[3][PlaceBlock::most];
};

class WayThroughCells {
 public:
  explicit WayThroughCells(const GasAround& gas);

  /// A loop over vectors where the caller's is.
  void cellsOf(const PlaceBlock& places, int count, CellBlock& cells) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int n = 0; n < count; ++n) {
        const double cell = std::floor((places.along[axis][n] - corner_[axis]) * perCell_);
        const double inside = std::max(-1.0, cell);  // not a number: outside
        cells.along[axis][n] = static_cast<std::int32_t>(std::min(inside, static_cast<double>(cells_[axis])));
      }
  }
  /// Whether something may stand between places and their goals: not 0 where it may. Loops over vectors where the
  /// caller's are.
  void mayMeet(const CellBlock& from, const CellBlock& to, int count, std::int32_t* meets) const {
    const std::uint32_t last[3] = {cells_.x - 1U, cells_.y - 1U, cells_.z - 1U};
    if (empty_)
      for (int n = 0; n < count; ++n) meets[n] = crosses(from, to, n) & goesFar(from, to, n, last);
    else
      for (int n = 0; n < count; ++n) meets[n] = crosses(from, to, n);
  }
  /// The numbers that are not 0, in order; returns how many. Without branches: which they are no processor foresees.
  static int list(const std::int32_t* asked, int count, std::int32_t* listed) {
    int number = 0;
    for (int n = 0; n < count; ++n) {
      listed[number] = n;
      number += asked[n] != 0;
    }
    return number;
  }
  /// Moves particle n from its place to its goal, one axis after the other, and stops it short of closed faces, when
  /// `goal` becomes what it reaches: particles slide along walls; beyond periodic faces they go on from the opposite
  /// ones. False when it leaves the box.
  bool move(const CellBlock& from, const CellBlock& to, int n, const PlaceBlock& place, PlaceBlock& goal) const {
    return toFreeNeighbour(from, to, n) || search(n, place, goal);
  }

 private:
  static std::int32_t crosses(const CellBlock& from, const CellBlock& to, int n) {
    std::int32_t differ = 0;
    for (int axis = 0; axis < 3; ++axis) differ |= from.along[axis][n] ^ to.along[axis][n];
    return differ != 0;
  }
  /// From or to outside the box, or beyond a neighbour.
  static std::int32_t goesFar(const CellBlock& from, const CellBlock& to, int n, const std::uint32_t (&last)[3]) {
    std::int32_t far = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t begin = from.along[axis][n], end = to.along[axis][n];
      far |= std::int32_t{begin > last[axis]} | std::int32_t{end > last[axis]} | std::int32_t{end - begin + 1 > 2};
    }
    return far;
  }
  bool toFreeNeighbour(const CellBlock& from, const CellBlock& to, int n) const;
  bool search(int n, const PlaceBlock& place, PlaceBlock& goal) const;

  const MacVelocity& openShare_;
  std::array<bool, 3> periodic_;
  bool empty_;
  Vec3i cells_;
  Vec3d corner_;
  double cellSize_, perCell_;
};

}  // namespace brisance
