// Pressure makes the velocity's divergence equal to the source (thesis 2.4.4): div grad p = (div u - phi) / dt.
#pragma once

#include <optional>

#include "fluid/conjugate_gradient.h"
#include "fluid/fast_poisson.h"

namespace brisance {

/// What the solvers keep between steps: memory and, for the same box, tables; no result depends on it.
struct PressureScratch {
  ConjugateGradientScratch conjugateGradient;
  std::optional<BoxPoisson> box;
  SolidSurface surface;
  SurfaceVectors surfaceVectors;
  CellField field, work;
};

/// Makes div u = phi over dt [s] and keeps the pressure (as the next start of conjugate_gradient). A sealed pocket with
/// a net source cannot obey: the mean over its cells is taken from the source if the settings say so, and reported,
/// else InputError.
PressureReport project(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch);

/// How well a velocity obeys its source, from itself, in double precision.
struct Continuity {
  double error = 0;  ///< |div u - phi| over the cells of gas relative to |phi| (L2; absolute where phi is 0 everywhere)
  double created = 0;  ///< [m3/s] of gas, by the source
};
Continuity continuityOf(const FluidState& gas);
inline double divergenceError(const FluidState& gas) { return continuityOf(gas).error; }
inline double createdVolume(const FluidState& gas) { return continuityOf(gas).created; }
/// [m3/s] leaving through the box's faces.
double outwardVolume(const FluidState& gas, const FluidSettings& settings);

}  // namespace brisance
