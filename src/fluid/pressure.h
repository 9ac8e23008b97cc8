// Pressure makes the velocity's divergence equal to the source (thesis 2.4.4): div grad p = (div u - phi) / dt.
#pragma once

#include "base/report.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// Seven-point operator h^2 (-div grad) on the cells of a box with solids. `share` holds, per face, 1 between two cells
/// of gas, 0 where closed, 2 on an open face of the box, where p = 0 lies half a cell away.
struct PressureOperator {
  Vec3i cells;
  MacVelocity share;
};
PressureOperator makePressureOperator(const SolidStamp& solid, const Faces& faces);

/// Vectors of the conjugate gradient iteration, each with one ghost cell around the box that stays zero.
struct PressureScratch {
  Grid3<double> x, r, d, q;
};

/// Solves the operator x = b by Algorithm 1 of the thesis (with beta's sign corrected), starting from what scratch.x
/// holds and with b in scratch.r, until |residual| <= tolerance |b|. In double: a float iteration reports residuals it
/// does not reach.
PressureReport solveConjugateGradient(const PressureOperator& op, const ConjugateGradient& settings,
                                      PressureScratch& scratch);

/// Makes div u = phi over dt [s] and keeps the pressure as the next start. A sealed pocket with a net source cannot
/// obey: its mean is removed if the settings say so, else Error(badScene).
PressureReport project(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch);

/// |div u - phi| over the cells of gas relative to |phi| (L2; absolute where phi is zero everywhere), from the velocity
/// itself.
double divergenceError(const FluidState& gas);
/// [m3/s] of gas created by the source, and leaving through the box's faces.
double createdVolume(const FluidState& gas, const FluidSettings& settings);
double outwardVolume(const FluidState& gas, const FluidSettings& settings);

}  // namespace brisance
