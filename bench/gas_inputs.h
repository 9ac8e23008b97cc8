// What the benchmarks of the gas solve.
#pragma once

#include "fluid/fluid_step.h"
#include "fluid/projection.h"

namespace brisance::bench {

FluidSettings boxOf(int cells, FaceKind kind = FaceKind::open);

/// A block on the floor, a ball, and a pane much thinner than a cell.
SolidStamp threeSolids(const FluidSettings& settings);

/// A right-hand side as an explosion makes it: clouds of sources, ripples, noise; no sum, none in solids.
CellField sourceField(const SolidStamp& solid);

/// |b - A x| / |b| in double precision, apart from any solver.
double trueResidual(const SolidStamp& solid, const Faces& faces, const CellField& b, const CellField& x);

}  // namespace brisance::bench
