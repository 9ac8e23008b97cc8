// The last sweep of a step over memory: the pressure's gradient is taken from the velocity, and while the rows at hand
// are in the nearest cache, the velocity that results is looked at.
#pragma once

#include "fluid/cell_field.h"
#include "fluid/flow_findings.h"

namespace brisance {

/// u += grad x through open faces, and pressure = x / dt, or += where a correction follows (`first` false). Returns
/// what lookAtFlow would find then.
FlowFindings closeStep(FluidState& gas, const Faces& faces, double dt, const CellField& x, bool first);

}  // namespace brisance
