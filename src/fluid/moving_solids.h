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

/// Of cells with cut faces: the largest sum over the axes of the faster gas in the open parts of two opposite faces
/// [m/s]; 0 where no face is cut.
double fastestCutCell(const FluidState& gas);

/// Puts the moving bodies where they are now, with their velocities. Cells that they uncover get what the gas around
/// them has.
void moveSolids(FluidState& gas, std::span<const MovingSolid> bodies, const FluidSettings& settings,
                SolidStamper& stamper);

}  // namespace brisance
