// A scene as a tree of keys, from wherever it comes: a file, or a program that has no file.
#pragma once

#include "scene/scene_reader.h"

namespace brisance {

struct SceneTree {
  SceneNode root;
  std::filesystem::path directory;  ///< that relative files are named from
  GivenMeshes meshes;
};

/// Throws InputError as readScene does.
SceneTree readSceneTree(const std::filesystem::path& file);
/// The scene that a tree means, after --set. Throws as readScene does.
Scene sceneOf(SceneTree tree, const std::vector<std::string>& overrides = {});

}  // namespace brisance
