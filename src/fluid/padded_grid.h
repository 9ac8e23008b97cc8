// A grid with one layer of ghost samples around it, so that stencils need no branches at the border.
#pragma once

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// Sample (i, j, k) of the inner grid lies at values(i + 1, j + 1, k + 1).
struct PaddedGrid {
  Grid3<float> values;
  float* row(int j, int k) { return values.values.data() + values.index(1, j + 1, k + 1); }
  const float* row(int j, int k) const { return values.values.data() + values.index(1, j + 1, k + 1); }
};

/// Ghosts of the velocity component along `axis` (thesis 2.4.3; Griebel et al. 1998, section 3.1.2): along a no-slip
/// wall reversed about the wall's speed, along a free-slip wall equal. Beyond an open face as inside where gas leaves,
/// and the outer air's where it comes in: with the inner velocity there too, a draught would feed on itself (measured:
/// 26 m/s through an open window long after the fire). Beyond a periodic face as inside the opposite one.
void fillSpeedGhosts(PaddedGrid& padded, int axis, const MacVelocity& velocity, const FluidSettings& settings);

/// Ghosts of a scalar beyond the faces across y and z, after those at the ends of rows (ghost_rows.h): where gas comes
/// in through an open face `ambient`, beyond a periodic one as inside the opposite, elsewhere as inside.
void fillScalarGhosts(PaddedGrid& padded, const MacVelocity& velocity, const Faces& faces, float ambient);

/// Ghosts of the pressure: p = 0 on an open face, half-way to the ghost.
void fillPressureGhosts(PaddedGrid& padded, const Faces& faces);

/// A copy with room for ghosts, which are not filled.
void copyInside(PaddedGrid& padded, const Grid3<float>& source);
/// The same room without the copy.
void resizePadded(PaddedGrid& padded, const Grid3<float>& source);

/// The box's velocity with its ghosts.
struct PaddedVelocity {
  PaddedGrid component[3];
  void fill(const MacVelocity& velocity, const FluidSettings& settings);
};

}  // namespace brisance
