// Values between the samples of a grid at many places at once.
#pragma once

#include <span>

#include "grid/grid3.h"

namespace brisance {

/// Trilinear values at some places, in single precision; beyond the samples the nearest ones hold. `values` has room
/// for one per place. The same bits with any vectors.
void interpolateMany(const Grid3<float>& grid, std::span<const Vec3d> places, float* values);

}  // namespace brisance
