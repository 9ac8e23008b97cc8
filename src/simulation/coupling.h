// What the solvers exchange within a sub-step. They do not know one another.
#pragma once

#include "simulation/world_state.h"

namespace brisance {

/// Particles burn: their fuel becomes heat, expansion, soot and flame on the grid.
void burnIntoGas(WorldState& world, const SimulationSettings& settings, double dt);
/// The gas moves and heats particles.
void carryParticles(WorldState& world, const SimulationSettings& settings, double dt);
/// The most that the source may reach in the next sub-step [1/s].
double expectedSource(const WorldState& world, const SimulationSettings& settings);

}  // namespace brisance
