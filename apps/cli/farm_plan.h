// What a run still lacks, and the jobs that would make it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farm_engine.h"
#include "options.h"
#include "scene/scene_file.h"

namespace brisance {

struct FarmNeeds {
  bool simulation = false;    ///< it has not come to its end
  std::vector<int> pictures;  ///< frames without one, rising
  bool film = false;
  bool nothing() const { return !simulation && pictures.empty() && !film; }
};

/// Of the whole scene; of a run that is not there: all.
FarmNeeds needsOf(const std::filesystem::path& run, const Scene& scene);

/// "3, 7-9"
std::string textOfFrames(const std::vector<int>& frames);
/// Frames of a task each: neighbours, at most `most` of them.
std::vector<FrameRange> chunksOf(const std::vector<int>& frames, int most);

/// A job and the number of the one before it; -1: none.
struct PlannedJob {
  FarmJob job;
  int after = -1;
};
/// Simulation, pictures, a look at what is missing then, film. `options` are those of the farm.
std::vector<PlannedJob> planOf(const FarmNeeds& needs, const Options& options);

}  // namespace brisance
