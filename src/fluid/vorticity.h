// Small whirls that the grid damps, given back.
#pragma once

#include "fluid/fluid_state.h"

namespace brisance {

/// Adds dt [s] times the force epsilon h (N x omega), N the unit gradient of |omega| (Fedkiw, Stam & Jensen 2001, eq.
/// 11), in one sweep over memory. `scratch` is overwritten.
void confineVorticity(FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& scratch);

}  // namespace brisance
