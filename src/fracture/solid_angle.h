// How much of the view a triangle fills.
#pragma once

#include "base/math.h"

namespace brisance {

/// Of a triangle seen from the origin [sr], above 0 where its back is seen: 4 pi in all from inside a closed surface
/// (Van Oosterom & Strackee 1983). Rounded differently by processors: for questions of yes or no.
inline double solidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(dot(a, cross(b, c)), below);
}

}  // namespace brisance
