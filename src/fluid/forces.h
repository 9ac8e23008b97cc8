// What accelerates gas besides pressure.
#pragma once

#include "fluid/fluid_state.h"

namespace brisance {

/// Adds dt [s] times the external force and the buoyancy of hot gas (Boussinesq: upward per kelvin above ambient).
void addForces(FluidState& gas, const FluidSettings& settings, double dt);

/// Gives back small whirls that the grid damps: force = epsilon h (N x omega), N the unit gradient of |omega|
/// (Fedkiw, Stam & Jensen 2001, eq. 11).
void confineVorticity(FluidState& gas, const FluidSettings& settings, double dt);

/// Brings the gas inside each stirring cylinder towards the speed of a turning solid.
void stir(FluidState& gas, const FluidSettings& settings, double dt);

}  // namespace brisance
