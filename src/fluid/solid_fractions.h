// Bodies that stand in the gas become closed faces.
#pragma once

#include <span>

#include "fluid/fluid_state.h"
#include "mesh/moving_solid.h"

namespace brisance {

/// A face is closed where the segment between its two cell centres crosses a triangle (so that walls thinner than a
/// cell block too: Guendelman et al. 2005) or where one of them lies inside a closed mesh (parity of the crossings
/// along x). Walled faces of the box are closed.
SolidStamp stampSolids(const FluidSettings& settings, std::span<const MovingSolid> solids);

}  // namespace brisance
