// One step of the gas: burn (done by the caller into heatRate, divergence, burnRate); advect; diffuse; addForces;
// project.
#pragma once

#include "base/report.h"
#include "fluid/advection.h"
#include "fluid/donor_sweep.h"
#include "fluid/pressure.h"

namespace brisance {

struct FluidScratch {
  AdvectionScratch advection;
  SweepScratch sweep;
  PressureScratch pressure;
};

/// What limits the next step.
struct StepLimits {
  double fastest = 0;  ///< [m/s] largest of all cells' sum |u_i|, of the faster of two opposite faces along each axis
  double hottest = 0;  ///< [K]
};
StepLimits limitsOf(const FluidState& gas);

/// What one step did.
struct FluidReport {
  StepLimits next;  ///< as limitsOf would find them now
  double courant = 0;
  double divergence = 0;
  PressureReport pressure;
  Balance volume;  ///< [m3]
  Balance heat;    ///< [J]
};

/// Advances the gas by dt [s]. `sootPerMass` turns burnt fuel into soot. `limits`: those of the gas as it is, if known.
FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                      FluidScratch& scratch, const StepLimits& limits);
inline FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                             FluidScratch& scratch) {
  return stepFluid(gas, settings, sootPerMass, dt, scratch, limitsOf(gas));
}

/// The largest of all cells' dt sum |u_i| / h, of the faster of two opposite faces along each axis; in cut faces of the
/// gas in their open part.
double courantNumber(const FluidState& gas, const StepLimits& limits, double dt);
inline double courantNumber(const FluidState& gas, double dt) { return courantNumber(gas, limitsOf(gas), dt); }

/// The longest stable step [s] for the gas as it moves now when its source may reach `largestSource` [1/s]: Courant
/// number, expansion dt <= 6 C / phi, acceleration. Viscosity and conduction set no limit.
double longestStep(const FluidState& gas, const FluidSettings& settings, double largestSource,
                   const StepLimits& limits);
inline double longestStep(const FluidState& gas, const FluidSettings& settings, double largestSource) {
  return longestStep(gas, settings, largestSource, limitsOf(gas));
}

/// The first value that is not a finite number, as "temperature at cell (i, j, k)"; empty when all are.
std::string findNotFinite(const FluidState& gas);

}  // namespace brisance
