#include "typed_scene.h"

#include "base/check.h"
#include "prepared_run.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

/// --set, and after it --size and --samples as the keys that they stand for, so that one reader checks them all.
std::vector<std::string> overridesOf(const Options& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.size) {
    overrides.push_back(fmt::format("render.width={}", options.size->width));
    overrides.push_back(fmt::format("render.height={}", options.size->height));
  }
  if (options.samples) overrides.push_back(fmt::format("render.samples={}", *options.samples));
  return overrides;
}

}  // namespace

Scene sceneAsTyped(const Options& options) {
  Scene scene = readScene(options.path, overridesOf(options));
  const int last = options.frames ? options.frames->last : 0;
  if (last > scene.simulation.frames)
    throw InputError(fmt::format("brisance: --frames: must end at or before the scene's {} frames, got {}",
                                 scene.simulation.frames, last));
  checkInputs(scene);
  return scene;
}

Scene sceneOfRun(const Options& options) {
  const fs::path file = options.path / "scene.toml";
  if (!fs::exists(file))
    throw InputError(
        fmt::format("{}: holds no scene.toml; name a directory that 'brisance run' or 'brisance simulate' made",
                    options.path.string()));
  const Scene made = readScene(file);
  Scene scene = readScene(file, overridesOf(options));
  Scene onlyPictures = scene;
  onlyPictures.simulation = made.simulation;
  const std::string key = firstDifference(writeScene(onlyPictures), writeScene(scene));
  if (!key.empty())
    throw InputError(fmt::format(
        "brisance: --set: {} belongs to the simulation, which is done; simulate it anew to change it", key));
  return scene;
}

}  // namespace brisance
