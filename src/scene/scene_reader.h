// Fills a draft from a tree, by the declarations of the keys.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "scene/scene_draft.h"
#include "scene/scene_text.h"

namespace brisance {

/// Meshes in memory, by what stands in the tree where a file is named otherwise.
using GivenMeshes = std::map<std::string, std::shared_ptr<const TriangleMesh>>;

/// Throws InputError "PLACE: table.key: what is wrong, what would be right, got X". Relative files become absolute from
/// `directory`.
SceneDraft readDraft(const SceneNode& root, const std::filesystem::path& directory, const GivenMeshes& given = {});

/// The tree with every key of a draft.
SceneNode writeDraft(SceneDraft draft);

}  // namespace brisance
