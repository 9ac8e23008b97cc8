// The scene file: read, defaulted, checked, and written back complete.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/render_settings.h"
#include "simulation/simulation_settings.h"

namespace brisance {

struct FilmSettings {
  double fps = 24;       ///< frames of film per second
  double timeScale = 1;  ///< simulated seconds per second of film; below 1: slow motion
  int rateFactor = 16;   ///< constant rate factor of the encoder: lower is better and larger
};

/// All that one scene file says, in SI units, every default filled in.
struct Scene {
  SimulationSettings simulation;
  RenderSettings render;
  FilmSettings film;
  std::vector<std::filesystem::path> inputs;  ///< every file that the scene names, absolute, each once
};

/// Reads and checks a scene. `overrides` are "key.path=value" as --set takes them; an element of an array of tables
/// goes by its name or its number from 0 ("bodies.pane.fracture.pieces=32"). Relative paths in the file are relative to
/// its folder. Throws InputError "FILE:LINE: table.key: what is wrong, what would be right, got X", also for files that
/// do not exist; Error(noRoom) when the grids can never fit this machine's memory.
Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
/// Likewise of a text, as if it stood in `file`.
Scene parseScene(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides = {});

/// The scene as TOML with every key written out, lengths in metres. Reading it gives the same scene.
std::string writeScene(const Scene& scene);

/// The scene with its files elsewhere: for a run's own scene.toml, whose files are "inputs/HASH.ext". `places` maps
/// each of scene.inputs to what shall be written. A file without a place keeps its path.
Scene withInputs(Scene scene, const std::map<std::filesystem::path, std::filesystem::path>& places);

}  // namespace brisance
