// Everything that the next sub-step depends on, as bytes.
#pragma once

#include <ostream>

#include "simulation/world_state.h"

namespace brisance {

void writeCheckpoint(const WorldState& world, std::ostream& out);
/// Into a world freshly made from the same settings. Throws DamagedFile when sizes or the format's version do not fit.
void readCheckpoint(const std::string& bytes, const std::string& fileName, WorldState& world);

}  // namespace brisance
