#include "scene/scene_file.h"

#include <fmt/format.h>

#include "base/check.h"
#include "base/durable_file.h"
#include "scene/estimate.h"
#include "scene/scene_tree.h"

namespace brisance {
namespace {

std::string readSceneText(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(fmt::format("{}: must be a scene file, and there is no such file", file.string()));
  return readFile(file);
}

SceneTree treeOf(const std::string& text, const std::filesystem::path& file) {
  return {parseToml(text, file.string()), std::filesystem::absolute(file).parent_path(), {}};
}

std::filesystem::path movedPath(const std::map<std::filesystem::path, std::filesystem::path>& places,
                                const std::filesystem::path& file) {
  const auto found = places.find(file);
  return found == places.end() ? file : found->second;
}

}  // namespace

SceneTree readSceneTree(const std::filesystem::path& file) { return treeOf(readSceneText(file), file); }

Scene sceneOf(SceneTree tree, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) applyOverride(tree.root, assignment);
  const SceneDraft draft = readDraft(tree.root, tree.directory, tree.meshes);  // first: it bounds what is walked next
  Scene scene = resolve(draft, placesOf(tree.root));
  requireMemory(scene, tree.root.place);
  return scene;
}

Scene parseScene(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides) {
  return sceneOf(treeOf(text, file), overrides);
}

Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return sceneOf(readSceneTree(file), overrides);
}

std::string writeScene(const Scene& scene) { return writeToml(writeDraft(draftOf(scene))); }

Scene withInputs(Scene scene, const std::map<std::filesystem::path, std::filesystem::path>& places) {
  for (BodySettings& body : scene.simulation.bodies)
    if (auto* mesh = std::get_if<MeshShape>(&body.shape)) mesh->file = movedPath(places, mesh->file);
  for (auto& [name, material] : scene.render.materials)
    if (auto* image = std::get_if<ImageTexture>(&material.diffuse)) image->file = movedPath(places, image->file);
  if (auto& file = scene.render.environment.file) file = movedPath(places, *file);
  for (std::filesystem::path& input : scene.inputs) input = movedPath(places, input);
  return scene;
}

}  // namespace brisance
