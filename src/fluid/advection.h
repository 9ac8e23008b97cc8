// Gas carries velocity, heat, soot and flame (thesis 2.4.2). In advective form: created gas has the local velocity and
// temperature, so a constant stays constant where div u is not zero (docs/departures.md).
#pragma once

#include "base/report.h"
#include "fluid/busy_rows.h"
#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"
#include "fluid/semi_lagrangian.h"

namespace brisance {

/// Scratch of one transport step.
struct AdvectionScratch {
  PaddedVelocity velocity;
  PaddedGrid scalar;
  PaddedVelocity stage[2];  ///< between the passes of a scheme
  MacVelocity newVelocity;
  Grid3<float> newScalar;
  FlowPaths paths;  ///< of semi_lagrangian
  BusyRows busy;    ///< of the scalar at hand
};

/// Whether the scratch knows the paths of the flow: it does when the last transport had the same velocity and step.
enum class Paths { toTrace, known };

/// Transports all velocity components over dt [s]; closed faces keep their speed.
void advectVelocity(FluidState& gas, const FluidSettings& settings, double dt, AdvectionScratch& scratch,
                    Paths paths = Paths::toTrace);

/// Transports a scalar over dt [s]; what comes in through open faces is `ambient`.
void carryScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient, double dt,
                 AdvectionScratch& scratch, Paths paths = Paths::toTrace);

/// The same, and the balance of (scalar - ambient) over the box, in scalar units x m3: `in` by created gas, `out`
/// through open faces. It closes for donor_cell, and for maccormack where that clamps nothing.
Balance advectScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient,
                     double dt, AdvectionScratch& scratch);

/// Stages of Runge and Kutta for differences of some weight w at Courant number C. The spectrum of their operator lies
/// in ellipses, C (-w + w cos t + i sin t). One stage, forward Euler, is stable for all of those with C <= w; two up to
/// C = 1.25 where w >= 0.2; three up to C = 1.25 for any w.
int donorStages(const DonorCell& scheme, double courant);

double largestMagnitude(const Grid3<float>& grid);
/// [m/s] the largest of all cells' sum |u_i|, of the faster of two opposite faces along each axis, as they stand.
double fastestCell(const FluidState& gas);
/// dt / h times that
double courantOfSpeeds(const FluidState& gas, double dt);

}  // namespace brisance
