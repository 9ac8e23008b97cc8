// Pressure makes the velocity's divergence equal to the source (thesis 2.4.4): div grad p = (div u - phi) / dt.
#pragma once

#include <optional>

#include "fluid/conjugate_gradient.h"
#include "fluid/fast_poisson.h"
#include "fluid/flow_findings.h"

namespace brisance {

/// What the solvers keep between steps: memory and, for the same box, tables; no result depends on it.
struct PressureScratch {
  ConjugateGradientScratch conjugateGradient;
  std::optional<BoxPoisson> box;
  SolidFaces surface;
  SurfaceVectors surfaceVectors;
  CellField field, work;
};

/// What a projection did and what it left.
struct Projection {
  PressureReport pressure;
  FlowFindings flow;
};
/// Makes div u = phi over dt [s] and keeps the pressure (as the next start of conjugate_gradient). A sealed pocket with
/// a net source cannot obey: the mean over its cells is taken from the source if the settings say so, and reported,
/// else InputError.
Projection projectAndLook(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch);
inline PressureReport project(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch) {
  return projectAndLook(gas, settings, dt, scratch).pressure;
}

/// How well a velocity obeys its source, from itself (FlowFindings::error).
inline double divergenceError(const FluidState& gas) { return lookAtFlow(gas).error(); }
/// [m3/s] of gas, by the source.
inline double createdVolume(const FluidState& gas) {
  return lookAtFlow(gas).created * std::pow(gas.pressure.cellSize, 3);
}
/// [m3/s] leaving through the box's faces.
double outwardVolume(const FluidState& gas, const FluidSettings& settings);

}  // namespace brisance
