// The donor-cell step of an explosion in two sweeps over memory: one for all scalars with what heats, cools and burns
// them, one for the velocity with what accelerates it. What advection.h, temperature.h and forces.h do one after the
// other, while the rows at hand are in the processor's caches.
#pragma once

#include "base/report.h"
#include "fluid/old_planes.h"

namespace brisance {

struct SweepScratch {
  MacVelocity velocity;  ///< written by a sweep, then swapped with the state's
  ChangingSpans spans;
  OldPlanes oldPlanes;
};

/// Whether they do all that the settings ask for in a step of some Courant number.
bool sweepsSuffice(const FluidSettings& settings, double courant);

/// What a step of dt [s] adds to soot and flame.
struct Burning {
  double sootPerMass, flameLifetime;  ///< [1], [s]
};

/// [kg/m3] Less soot or flame, which nobody could see, becomes none: else its traces would spread by a cell with every
/// step.
constexpr float leastDensity = 1e-12f;

/// Carries temperature, soot and flame over dt [s], heats and cools the gas, adds what burnt. Returns the balance of
/// heat [J]; `hottest` becomes the largest temperature [K].
Balance sweepScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                     SweepScratch& scratch, double& hottest);

/// Carries the velocity over dt [s] and adds external forces and buoyancy; closed faces keep their speed.
void sweepVelocity(FluidState& gas, const FluidSettings& settings, double dt, SweepScratch& scratch);

}  // namespace brisance
