// The scene's bodies, broken and at rest.
#pragma once

#include "mesh/moving_solid.h"
#include "simulation/world_state.h"

namespace brisance {

/// Fills bodies and looks; returns what stands in the gas.
std::vector<MovingSolid> makeBodies(const SimulationSettings& settings, WorldState& world);

}  // namespace brisance
