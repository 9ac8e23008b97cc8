// Algorithm 1 of the thesis: conjugate gradients on the pressure, in double precision.
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
struct ConjugateGradientScratch {
  Grid3<double> x, r, d, q;
};

/// Solves the operator x = b by Algorithm 1 of the thesis (with beta's sign corrected), starting from what scratch.x
/// holds and with b in scratch.r, until |residual| <= tolerance |b|. In double: a float iteration reports residuals it
/// does not reach.
PressureReport solveConjugateGradient(const PressureOperator& op, const ConjugateGradient& settings,
                                      ConjugateGradientScratch& scratch);

/// b = h^2 (phi - div u) into scratch.r, and as the start the last pressure times dt into scratch.x.
void startConjugateGradient(const FluidState& gas, double dt, ConjugateGradientScratch& scratch);
/// u += grad x, per component; p = x / dt.
void applySolution(FluidState& gas, const PressureOperator& op, double dt, const ConjugateGradientScratch& scratch);

}  // namespace brisance
