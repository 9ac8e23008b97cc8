// Gradient noise (Perlin 1985, 2002) and its harmonic sum.
#pragma once

#include "base/math.h"

namespace brisance {

/// Smooth random numbers of mean 0 over space, mostly within -1 .. 1; 0 at whole coordinates. Two derivatives are
/// continuous. It repeats after 256 along each axis.
double gradientNoise(const Vec3d& place);

/// PerlinNoise3D of appendix A.1.3: the sum over i < n of gradientNoise(place beta^i) / alpha^i.
struct NoiseHarmonics {
  double alpha;  ///< by which each harmonic is weaker than the one before
  double beta;   ///< by which it is finer
  int count;     ///< n
};
double harmonicNoise(const Vec3d& place, const NoiseHarmonics& harmonics);

}  // namespace brisance
