// The player as one file: the page with all that it would ask a server for inside.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "view/player_run.h"

namespace brisance {

/// `told(done, total)` is called after every frame.
using FramesDone = std::function<void(int done, int total)>;

/// The page with the run's description, pieces and these frames before its own script, in base 64. Stops early, with a
/// page that is not whole, when asked to.
std::string standalonePage(const std::string& page, const PlayerRun& run, const std::vector<int>& frames,
                           const FramesDone& told, const StopRequested& stop);

std::string base64(const std::string& bytes);

}  // namespace brisance
