// Semi-Lagrangian transport (Stam 1999): each sample takes the value of the place whence the flow brought it.
#pragma once

#include <array>

#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"

namespace brisance {

/// Where samples lie in the box: at cell centres, or on the faces across an axis.
struct SampleGrid {
  static constexpr int cells = -1;
  const Faces& faces;
  int axis = cells;
};

/// [cells] per axis, from each cell's centre to where its gas was a step before.
using FlowPaths = std::array<Grid3<float>, 3>;

/// Follows the flow back over dt [s] from the cells' centres, by the midpoint rule (Runge-Kutta 2), with velocities
/// trilinear between samples.
void tracePaths(const PaddedVelocity& velocity, const Faces& faces, double dt, FlowPaths& paths);

/// result = old at the place where each sample was before, trilinear between samples; a face's gas came half-way
/// between where that of the two cells beside it did. What is closed keeps its value. Places stop at walls of the box;
/// a scalar's also stop short of what closes a face inside it, and take no value from behind one.
void carryBack(const FluidState& gas, const SampleGrid& samples, const FlowPaths& paths, const PaddedGrid& old,
               Grid3<float>& result);

}  // namespace brisance
