// The energy transport equation's local terms (thesis 2.2, corrected by docs/departures.md).
#pragma once

#include "base/report.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// Temperature above ambient after dt [s] of radiative cooling d theta/dt = -c_r (theta / range)^4, in closed form; gas
/// below ambient does not cool. `range` = T_max - T_a [K], `rate` = c_r [K/s].
double cooled(double theta, double range, double rate, double dt);

/// Conducts, heats and cools all cells over dt [s]. Returns [J]: `in` what the heat source released, `lost` what was
/// radiated.
Balance heatAndCool(FluidState& gas, const FluidSettings& settings, double dt);

/// Heat that the box holds above ambient [J].
double heatContent(const FluidState& gas, const FluidSettings& settings);

}  // namespace brisance
