// The donor-cell differences of donor_cell.h for rows of samples that lie anywhere, in the sweeps of donor_sweep.h.
#pragma once

#include <cmath>

#include "base/aligned.h"
#include "fluid/fluid_state.h"
#include "fluid/ghost_rows.h"
#include "fluid/solid_rows.h"

namespace brisance {

/// A row of samples and the rows around it.
struct Neighbours {
  const float *here, *lower[3], *upper[3];
};

/// Speeds at the two sides of a cell along each axis.
struct CellSides {
  const float *lowerFace[3], *upperFace[3];
  static constexpr float perSpeed = 1;
  float lower(int axis, std::int64_t i) const { return lowerFace[axis][i]; }
  float upper(int axis, std::int64_t i) const { return upperFace[axis][i]; }
  float divergence(std::int64_t i) const {
    return (upper(0, i) - lower(0, i)) + (upper(1, i) - lower(1, i)) + (upper(2, i) - lower(2, i));
  }
};

/// At the sides of a face's control volume, which reaches from centre to centre of its two cells: sums of two speeds,
/// twice their mean.
struct FaceSides {
  const float *lowerPair[3][2], *upperPair[3][2];
  static constexpr float perSpeed = 2;
  float lower(int axis, std::int64_t i) const { return lowerPair[axis][0][i] + lowerPair[axis][1][i]; }
  float upper(int axis, std::int64_t i) const { return upperPair[axis][0][i] + upperPair[axis][1][i]; }
};

/// By how much a sample comes towards its neighbours, in units of the c of `carried`.
struct DonorShares {
  float lower[3], upper[3];

  template <class Sides>
  DonorShares(const Sides& sides, float upwindWeight, std::int64_t i) {
    for (int axis = 0; axis < 3; ++axis) {
      const float below = sides.lower(axis, i), above = sides.upper(axis, i);
      lower[axis] = below + upwindWeight * std::abs(below);
      upper[axis] = above - upwindWeight * std::abs(above);
    }
  }
};

/// s - dt (u . grad) s, for c = dt / (2 h perSpeed).
inline float carried(const Neighbours& s, const DonorShares& share, float c, std::int64_t i) {
  const float here = s.here[i];
  const auto along = [&](int axis) {
    return share.upper[axis] * (s.upper[axis][i] - here) + share.lower[axis] * (here - s.lower[axis][i]);
  };
  return here - c * ((along(0) + along(1)) + along(2));
}

/// Rows that are made: those beyond the box, and copies with ghosts at their ends.
class Rooms {
 public:
  Rooms(int length, int count)
      : width_((length + lineFloats - 1) / lineFloats * lineFloats + 2 * lineFloats),
        floats_(width_ * static_cast<std::size_t>(count), 0.0f) {}
  float* operator[](int n) { return floats_.data() + n * width_; }

 private:
  std::int64_t width_;
  AlignedVector<float> floats_;
};

/// Of a row that needs no ghosts at its ends. Takes four rooms.
inline Neighbours neighboursInside(const GhostRows& rows, int j, int k, Rooms& rooms, int room) {
  const float* here = rows.row(j, k, nullptr);
  if (rows.inside(j, k))
    return {here,
            {here - 1, here - rows.stride(1), here - rows.stride(2)},
            {here + 1, here + rows.stride(1), here + rows.stride(2)}};
  return {here,
          {here - 1, rows.row(j - 1, k, rooms[room]), rows.row(j, k - 1, rooms[room + 1])},
          {here + 1, rows.row(j + 1, k, rooms[room + 2]), rows.row(j, k + 1, rooms[room + 3])}};
}

/// With ghosts, of a row of which there is a copy with ghosts at its ends. Takes four rooms.
inline Neighbours neighboursOfEnded(const GhostRows& rows, int j, int k, const float* ended, Rooms& rooms, int room) {
  Neighbours s = neighboursInside(rows, j, k, rooms, room);
  s.here = ended;
  s.lower[0] = s.here - 1;
  s.upper[0] = s.here + 1;
  return s;
}
/// Likewise, copying it. Takes five rooms.
inline Neighbours neighboursOf(const GhostRows& rows, int j, int k, Rooms& rooms, int room) {
  return neighboursOfEnded(rows, j, k, rows.withEnds(j, k, rooms[room + 4]), rooms, room);
}

inline float upwindWeightOf(const FluidSettings& settings) {
  return static_cast<float>(std::get<DonorCell>(settings.advection).upwindWeight);
}

template <class T>
void sizeAs(Grid3<T>& grid, const Grid3<T>& model) {
  if (!(grid.size == model.size)) grid = model;
}

}  // namespace brisance
