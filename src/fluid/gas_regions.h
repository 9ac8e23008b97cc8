// Gas that hangs together.
#pragma once

#include "fluid/fluid_state.h"

namespace brisance {

/// Numbers connected gas across faces that are open at all, and says which of it reaches an open face of the box.
void findRegions(const Faces& faces, SolidStamp& stamp);

}  // namespace brisance
