// Semi-Lagrangian transport (Stam 1999): each sample takes the value of the place whence the flow brought it.
#pragma once

#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"

namespace brisance {

/// Where samples lie in the box: at cell centres, or on the faces across an axis.
struct SampleGrid {
  static constexpr int cells = -1;
  const Faces& faces;
  int axis = cells;
};

/// result = old at the place where each sample was dt [s] before, found by the midpoint rule (Runge-Kutta 2), trilinear
/// between samples. What is closed keeps its value. Places stop at walls of the box; a scalar's also stop short of what
/// closes a face inside it, and take no value from behind one.
void traceBack(const FluidState& gas, const PaddedVelocity& velocity, const SampleGrid& samples, double dt,
               const PaddedGrid& old, Grid3<float>& result);

}  // namespace brisance
