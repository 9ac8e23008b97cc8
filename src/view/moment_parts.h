// What a moment file holds: arrays, and where they are as JSON. The names are those of docs/player.md.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "view/compact_gas.h"
#include "view/moment_file.h"

namespace brisance {

/// Position, orientation, speed, temperature and frame of the shape, one entry for each of `places` (bodies by name);
/// bodies that are not there have the shape -1.
nlohmann::json addPoses(const std::vector<FrameBody>& bodies, const std::map<std::string, std::size_t>& places,
                        MomentArrays& arrays);

/// Some thousands of the particles, every so many of each kind.
nlohmann::json addPoints(const FrameParticles& particles, const HeatScale& scale, MomentArrays& arrays);

nlohmann::json addGas(const CompactGas& gas, MomentArrays& arrays);

nlohmann::json reportOf(const StepReport& report);

}  // namespace brisance
