// The page of the player, and what it is told of a scene.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene_file.h"
#include "view/player_run.h"

namespace brisance {

/// The page that the build laid beside the program. Throws Error(failed) where it made none, for want of Node.js.
std::string playerPage();

/// The scene in a run's directory. Throws InputError where there is none.
Scene sceneOfRun(const std::filesystem::path& run);

PlayerScene playerSceneOf(const Scene& scene, const std::filesystem::path& run);

}  // namespace brisance
