// The scene that a command works on, as it was typed.
#pragma once

#include "options.h"
#include "scene/scene_file.h"

namespace brisance {

/// The scene of `run` and `simulate`, its files looked into.
Scene sceneAsTyped(const Options& options);

/// A run's own scene. Throws InputError when --set wants what only a new simulation can give.
Scene sceneOfRun(const Options& options);

}  // namespace brisance
