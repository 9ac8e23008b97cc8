// Progress and interruption, as the working code sees them; who draws the bar lives in apps/.
#pragma once

#include <functional>
#include <string>

namespace brisance {

/// Told after each piece of work: which stage ("simulate"), how many are done of how many.
using ProgressSink = std::function<void(const std::string& stage, int done, int total)>;
/// Asked between pieces of work: true once the user wants to stop.
using StopRequested = std::function<bool()>;
/// Thrown by work that was asked to stop and has nothing to show for itself yet.
struct Interrupted {};

}  // namespace brisance
