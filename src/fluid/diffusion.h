// Viscosity and conduction: ds/dt = k (d2/dx2 + d2/dy2 + d2/dz2) s, one axis after the other, as the exact solution is
// a product of the three. Along an axis explicitly where that damps every wave without turning it over, else by a
// backward Euler step, which does so for steps of any length (Douglas 1955; locally one-dimensional, Yanenko 1971).
#pragma once

#include "fluid/fluid_state.h"

namespace brisance {

/// Diffuses all velocity components over dt [s] by the viscosity. Along a no-slip wall the gas has the wall's speed, at
/// closed faces the speed they have; there is no friction across a free-slip wall or an open face.
void diffuseVelocity(FluidState& gas, const FluidSettings& settings, double dt);

/// Diffuses the temperature over dt [s] by the conductivity, through open faces between cells and around a periodic
/// box; no heat is conducted through the other faces of the box (thesis 2.4.3).
void conduct(FluidState& gas, const FluidSettings& settings, double dt);

}  // namespace brisance
