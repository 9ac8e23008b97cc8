// Gas whose solids move.
#pragma once

#include <span>

#include "fluid/solid_fractions.h"

namespace brisance {

/// Between steps the velocity at a face is the mean over all of it, so that what passes is its sum over faces, bodies
/// and all. While gas is carried and accelerated it is the velocity of the gas alone, in the open part; a closed face
/// keeps the body's.
void takeGasVelocity(FluidState& gas);
void takeMeanVelocity(FluidState& gas);

/// The fastest gas along an axis in the open part of any face, where the mean velocity reaches `fastestMean` [m/s].
double fastestGas(const FluidState& gas, int axis, double fastestMean);

/// Puts the moving bodies where they are now, with their velocities. Cells that they uncover get what the gas around
/// them has.
void moveSolids(FluidState& gas, std::span<const MovingSolid> bodies, const FluidSettings& settings,
                SolidStamper& stamper);

}  // namespace brisance
