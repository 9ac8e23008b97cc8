// Rows of samples along x, and what lies beyond the box, without a copy of the grid.
#pragma once

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// Ghosts as in padded_grid.h, of a velocity component or of a scalar: those of the same box come to the same bits.
class GhostRows {
 public:
  /// `along`: the axis of a velocity component, -1 for a scalar. `outer`: what comes in through open faces.
  GhostRows(const Grid3<float>& samples, int along, float outer, const MacVelocity& velocity, const Faces& faces)
      : samples_(samples), along_(along), outer_(outer), velocity_(velocity), faces_(faces) {}

  int length() const { return samples_.size.x; }
  /// Row (j, k), one of which may be one beyond the samples. `room` holds length() floats, for a row that is made.
  const float* row(int j, int k, float* room) const;
  /// A copy of a row inside with its ghosts at [-1] and [length()]. `room` holds length() + 2 floats.
  const float* withEnds(int j, int k, float* room) const;

 private:
  float end(int face, int j, int k) const;
  const float* madeRow(int face, int j, int k, float* room) const;
  bool reversedAt(int face) const { return along_ >= 0 && face / 2 != along_ && faces_[face] == FaceKind::noSlip; }
  /// Samples after which the axis of a periodic face begins again.
  int period(int axis) const { return samples_.size[axis] - (along_ == axis ? 1 : 0); }

  const Grid3<float>& samples_;
  int along_;
  float outer_;
  const MacVelocity& velocity_;
  const Faces& faces_;
};

}  // namespace brisance
