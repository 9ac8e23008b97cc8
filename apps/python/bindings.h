// The parts of the Python module, and the types that they share.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/render_frame.h"
#include "scene/scene_tree.h"
#include "simulation/world.h"

namespace brisance::python {

namespace py = pybind11;

/// A mesh is never changed, so all who name it share it.
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;
};

/// A scene, and what it was read from.
class SceneHandle {
 public:
  SceneHandle(SceneTree tree, std::vector<std::string> overrides);
  const Scene& scene() const { return scene_; }
  /// The same scene with more said by --set.
  std::shared_ptr<SceneHandle> with(const std::vector<std::string>& more) const;
  /// The scene as TOML. Throws InputError where a mesh is in no file.
  std::string toml() const;
  /// What its pictures share, read once; from any thread.
  std::shared_ptr<const RenderAssets> assets() const;

 private:
  SceneTree tree_;
  std::vector<std::string> overrides_;
  Scene scene_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const RenderAssets> assets_;
};

/// A dictionary of tables as a scene's tree. Throws InputError for what no scene can hold.
SceneTree treeOfDictionary(const py::dict& tables, const std::filesystem::path& directory);

/// What may be asked of a picture; none: as the scene says.
struct PictureWish {
  std::optional<int> width, height;
  std::optional<double> samples;
  bool alpha = false;
};
/// The picture of a frame, an array of (height, width, 3 or 4).
py::array pictureOf(const SceneHandle& scene, const Frame& frame, const PictureWish& wish);

void bindExceptions(py::module_& module);
void bindMeshes(py::module_& module);
void bindScenes(py::module_& module);
void bindFrames(py::module_& module);
void bindPictures(py::module_& module);
void bindWorlds(py::module_& module);

}  // namespace brisance::python
