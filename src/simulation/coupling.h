// What the solvers exchange within a sub-step. They do not know one another.
#pragma once

#include "simulation/world_state.h"

namespace brisance {

/// Particles burn: their fuel becomes heat, expansion, soot and flame on the grid.
void burnIntoGas(WorldState& world, const SimulationSettings& settings, double dt);
/// The gas moves and heats particles.
/// Sparks of charges whose time has come; dust from where a body's pieces are released.
void giveBits(WorldState& world, const SimulationSettings& settings);
void carryParticles(WorldState& world, const SimulationSettings& settings, double dt);
/// Gas carries the vertices of bodies that swell, and makes them rigid when they are released.
void swellBodies(WorldState& world, double dt);
/// Bodies take up the temperature of the gas at their surfaces.
void warmBodies(WorldState& world, double dt);
/// Lets pressure move the bodies that are free now, in the gas' next step.
void releaseBodies(WorldState& world, const SimulationSettings& settings);
/// Bodies have the velocities that the gas' pressure gave them.
void takePush(WorldState& world);
/// Puts moving bodies into the gas where they are now. `anew`: the gas' velocity is already that of these places.
void blockGas(WorldState& world, const SimulationSettings& settings, bool anew);
/// The most that the source may reach in the next sub-step [1/s].
double expectedSource(const WorldState& world, const SimulationSettings& settings);

}  // namespace brisance
