// Gas carries velocity, heat, soot and flame (thesis 2.4.2). In advective form: created gas has the local velocity and
// temperature, so a constant stays constant where div u is not zero (docs/departures.md).
#pragma once

#include "base/report.h"
#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"

namespace brisance {

/// Flux of a quantity between two samples, carried at `speed` from left to right where positive:
/// Griebel et al. 1998, eq. 3.19.
inline float donorFlux(float speed, float left, float right, float upwindWeight) {
  return 0.5f * (speed * (left + right) - upwindWeight * std::abs(speed) * (right - left));
}

/// At the two sides of a control volume along one axis.
struct Sides {
  float lower, upper;
};
/// What the fluxes through both sides take from a sample, less the sample times what they carry in all: h (u ds/dx) of
/// the same scheme. `difference`: of the sample and its neighbours, upper less lower.
inline float donorDifference(Sides speed, Sides difference, float upwindWeight) {
  return 0.5f * ((speed.upper - upwindWeight * std::abs(speed.upper)) * difference.upper +
                 (speed.lower + upwindWeight * std::abs(speed.lower)) * difference.lower);
}

/// Scratch of one transport step.
struct AdvectionScratch {
  PaddedVelocity velocity;
  PaddedGrid scalar;
  MacVelocity newVelocity;
  Grid3<float> newScalar;
};

/// Transports all velocity components over dt [s], and diffuses them by the viscosity; closed faces keep their speed.
void advectVelocity(FluidState& gas, const FluidSettings& settings, double dt, AdvectionScratch& scratch);

/// Transports a scalar over dt [s]; what comes in through open faces is `ambient`. Returns the balance of (scalar -
/// ambient) over the box, in scalar units x m3: `in` by created gas, `out` through open faces.
Balance advectScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient,
                     double dt, AdvectionScratch& scratch);

}  // namespace brisance
