// The world's moment as a Frame.
#pragma once

#include "frame/gas_file.h"
#include "simulation/world_state.h"

namespace brisance {

/// Reads from the world, which must outlive it.
GasSource gasOf(const WorldState& world, const SimulationSettings& settings);
Frame captureWithoutGas(const WorldState& world);
Frame captureFrame(const WorldState& world, const SimulationSettings& settings);

}  // namespace brisance
