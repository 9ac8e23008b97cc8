// A run directory and the scene in it, ready to be worked on.
#pragma once

#include <filesystem>
#include <string>

#include "frame/run_directory.h"
#include "options.h"
#include "scene/scene_file.h"

namespace brisance {

/// Reads every mesh and texture of a scene once, so that a damaged one is found before anything is written.
/// Throws DamagedFile or InputError.
void checkInputs(const Scene& scene);

/// The run directory of a scene, with its inputs and scene.toml in it. Throws InputError when a run is there and
/// `existing` does not say what to do with it, or when it is to be resumed and was made from another scene (more frames
/// are welcome).
RunDirectory prepareRun(const Scene& scene, const std::filesystem::path& path, ExistingRun existing);

/// "table.key" of the first line in which two written scenes differ; empty: none.
std::string firstDifference(const std::string& before, const std::string& now);

}  // namespace brisance
