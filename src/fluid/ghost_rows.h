// Rows of samples along x, and what lies beyond the box, without a copy of the grid.
#pragma once

#include <algorithm>
#include <cstring>

#include "base/row_lines.h"
#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// Ghosts as in padded_grid.h, of a velocity component or of a scalar: those of the same box come to the same bits.
class GhostRows {
 public:
  /// `along`: the axis of a velocity component, -1 for a scalar. `outer`: what comes in through open faces.
  GhostRows(const Grid3<float>& samples, int along, float outer, const MacVelocity& velocity, const Faces& faces);

  int length() const { return samples_.size.x; }
  /// From a row to the next along y or z.
  std::int64_t stride(int axis) const { return samples_.stride(axis); }
  /// Whether row (j, k) has samples on all four sides.
  bool inside(int j, int k) const { return j > 0 && k > 0 && j + 1 < samples_.size.y && k + 1 < samples_.size.z; }
  /// Whether there is a row (j, k).
  bool has(int j, int k) const { return j >= 0 && k >= 0 && j < samples_.size.y && k < samples_.size.z; }
  /// Row (j, k), one of which may be one beyond the samples. `room` holds length() floats, for a row that is made.
  const float* row(int j, int k, float* room) const { return has(j, k) ? &samples_(0, j, k) : rowBeyond(j, k, room); }
  /// A copy of a row that there is. A few cache lines: calling the library for them takes longer than copying.
  void copyRow(int j, int k, float* to) const {
    const float* from = &samples_(0, j, k);
    const int count = length();
    int i = 0;
    for (; i + lineFloats <= count; i += lineFloats) std::memcpy(to + i, from + i, lineFloats * sizeof(float));
    for (; i < count; ++i) to[i] = from[i];
  }
  /// Likewise of samples [first, end) alone, with their neighbours at both ends, or ghosts at [-1] and [length()].
  void copyPart(int j, int k, int first, int end, float* to) const {
    const float* from = &samples_(0, j, k);
    for (int i = first; i < end; ++i) to[i] = from[i];
    if (first > 0) to[first - 1] = from[first - 1];
    if (end < length()) to[end] = from[end];
    if (first == 0 || end == length()) addEnds(rowsOfCrossing(j, k), velocity_.u, to);
  }

  /// Rows of cells whose speeds along x, added, tell whether gas comes in at the ends of a row of samples: a velocity
  /// component along another axis lies between two cells.
  struct CrossingRows {
    int jBefore, kBefore, jAt, kAt;
  };
  CrossingRows rowsOfCrossing(int j, int k) const {
    const Vec3i cells = velocity_.u.size;
    return {along_ == 1 ? std::max(j - 1, 0) : j, along_ == 2 ? std::max(k - 1, 0) : k, std::min(j, cells.y - 1),
            std::min(k, cells.z - 1)};
  }
  /// Writes the ghosts at [-1] and [length()] of a copied row. `speeds(i, j, k)`: u.
  template <class Speeds>
  void addEnds(const CrossingRows& rows, const Speeds& speeds, float* copy) const {
    for (const int side : {0, 1}) {
      const End& at = ends_[side];
      float ghost = at.sign * copy[at.source];
      if (at.open) {
        const float crossing = speeds(at.face, rows.jBefore, rows.kBefore) + speeds(at.face, rows.jAt, rows.kAt);
        ghost = select(side ? crossing < 0 : crossing > 0, outer_, ghost);
      }
      copy[side ? length() : -1] = ghost;
    }
  }

 private:
  /// What is known of all ghosts beyond one of the two faces across x.
  struct End {
    std::int64_t source;  ///< place in the row of the sample that the ghost equals, or is the reverse of
    float sign;
    bool open;  ///< where gas comes in, the ghost is `outer` instead
    int face;   ///< place in a row of the velocity along x
  };
  End endOf(int side) const;
  const float* rowBeyond(int j, int k, float* room) const;
  const float* madeRow(int face, int j, int k, float* room) const;
  bool reversedAt(int face) const { return along_ >= 0 && face / 2 != along_ && faces_[face] == FaceKind::noSlip; }
  /// Samples after which the axis of a periodic face begins again.
  int period(int axis) const { return samples_.size[axis] - (along_ == axis ? 1 : 0); }

  const Grid3<float>& samples_;
  int along_;
  float outer_;
  const MacVelocity& velocity_;
  const Faces& faces_;
  End ends_[2];
};

}  // namespace brisance
