// The world's moment as a Frame.
#pragma once

#include "simulation/world_state.h"

namespace brisance {

Frame captureFrame(const WorldState& world, const SimulationSettings& settings);

}  // namespace brisance
