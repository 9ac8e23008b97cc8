// Rows of samples along x, and what lies beyond the box, without a copy of the grid.
#pragma once

#include <algorithm>
#include <cstring>

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
  /// Row (j, k), one of which may be one beyond the samples. `room` holds length() floats, for a row that is made.
  const float* row(int j, int k, float* room) const {
    const bool inside = j >= 0 && k >= 0 && j < samples_.size.y && k < samples_.size.z;
    return inside ? &samples_(0, j, k) : rowBeyond(j, k, room);
  }
  /// A copy of a row inside with its ghosts at [-1] and [length()]. `room` holds length() + 2 floats.
  const float* withEnds(int j, int k, float* room) const {
    float* copy = room + 1;
    copyRow(&samples_(0, j, k), length(), copy);
    copy[-1] = end(0, j, k);
    copy[length()] = end(1, j, k);
    return copy;
  }
  /// The ghost before (side 0) or after (1) a row inside.
  float end(int side, int j, int k) const;

 private:
  /// What is known of all ghosts beyond one of the two faces across x.
  struct End {
    std::int64_t source;  ///< place in the row of the sample that the ghost equals, or is the reverse of
    float sign;
    bool open;          ///< where gas comes in, the ghost is `outer` instead
    std::int64_t face;  ///< place in a row of the velocity along x
  };
  End endOf(int side) const;
  /// A few cache lines: calling the library for them takes longer than copying.
  static void copyRow(const float* from, int count, float* to) {
    constexpr int line = 16;
    int i = 0;
    for (; i + line <= count; i += line) std::memcpy(to + i, from + i, line * sizeof(float));
    for (; i < count; ++i) to[i] = from[i];
  }
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

inline float GhostRows::end(int side, int j, int k) const {
  const End& at = ends_[side];
  const float inside = at.sign * samples_.values[samples_.index(0, j, k) + at.source];
  if (!at.open) return inside;
  const Grid3<float>& u = velocity_.u;  // a component along y or z lies between two rows of cells
  const int jBefore = along_ == 1 ? std::max(j - 1, 0) : j, kBefore = along_ == 2 ? std::max(k - 1, 0) : k;
  const int jAt = std::min(j, u.size.y - 1), kAt = std::min(k, u.size.z - 1);
  const float crossing = u.values[u.index(0, jBefore, kBefore) + at.face] + u.values[u.index(0, jAt, kAt) + at.face];
  const bool comesIn = side ? crossing < 0 : crossing > 0;
  return comesIn ? outer_ : inside;
}

}  // namespace brisance
