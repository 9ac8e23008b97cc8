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
  /// Those of the places, in order, that lie in other cells than their goals; returns how many. Without branches: which
  /// they are no processor foresees.
  static int listCrossing(const CellBlock& from, const CellBlock& to, int count, std::int32_t* listed) {
    int number = 0;
    for (int n = 0; n < count; ++n) {
      listed[number] = n;
      number += ((from.along[0][n] ^ to.along[0][n]) | (from.along[1][n] ^ to.along[1][n]) |
                 (from.along[2][n] ^ to.along[2][n])) != 0;
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
  bool toFreeNeighbour(const CellBlock& from, const CellBlock& to, int n) const;
  bool search(int n, const PlaceBlock& place, PlaceBlock& goal) const;

  const MacVelocity& openShare_;
  std::array<bool, 3> periodic_;
  Vec3i cells_;
  Vec3d corner_;
  double cellSize_, perCell_;
};

}  // namespace brisance
