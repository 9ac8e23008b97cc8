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

/// What one step did.
struct FluidReport {
  double courant = 0;
  double divergence = 0;
  PressureReport pressure;
  Balance volume;  ///< [m3]
  Balance heat;    ///< [J]
};

/// Advances the gas by dt [s]. `sootPerMass` turns burnt fuel into soot.
FluidReport stepFluid(FluidState& gas, const FluidSettings& settings, double sootPerMass, double dt,
                      FluidScratch& scratch);

/// dt sum(max |u_i|) / h of the gas as it is, in cut faces of the gas in their open part.
double courantNumber(const FluidState& gas, double dt);

/// The longest stable step [s] for the gas as it moves now when its source may reach `largestSource` [1/s]: Courant
/// number, expansion dt <= 6 C / phi, acceleration. Viscosity and conduction set no limit.
double longestStep(const FluidState& gas, const FluidSettings& settings, double largestSource);

/// The first value that is not a finite number, as "temperature at cell (i, j, k)"; empty when all are.
std::string findNotFinite(const FluidState& gas);

}  // namespace brisance
