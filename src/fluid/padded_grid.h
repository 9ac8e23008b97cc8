// A grid with one layer of ghost samples around it, so that stencils need no branches at the border.
#pragma once

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// Sample (i, j, k) of the inner grid lies at values(i + 1, j + 1, k + 1).
struct PaddedGrid {
  Grid3<float> values;
  const float* row(int j, int k) const { return values.values.data() + values.index(1, j + 1, k + 1); }
};

/// The box's velocity with ghosts (thesis 2.4.3; Griebel et al. 1998, section 3.1.2): along a no-slip wall reversed,
/// along a free-slip wall equal. Beyond an open face as inside where gas leaves, and the outer air's where it comes in:
/// with the inner velocity there too, a draught would feed on itself (measured: 26 m/s through an open window long
/// after the fire).
struct PaddedVelocity {
  PaddedGrid component[3];
  void fill(const MacVelocity& velocity, const Faces& faces, const Vec3d& wind);
};

/// A scalar with ghosts: where gas comes in through an open face `ambient`, beyond a periodic one as inside the
/// opposite, elsewhere as inside.
void padScalar(PaddedGrid& padded, const Grid3<float>& scalar, const MacVelocity& velocity, const Faces& faces,
               float ambient);

}  // namespace brisance
