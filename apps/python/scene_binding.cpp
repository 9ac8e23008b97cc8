#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "base/check.h"
#include "bindings.h"

namespace brisance::python {

SceneHandle::SceneHandle(SceneTree tree, std::vector<std::string> overrides)
    : tree_(std::move(tree)), overrides_(std::move(overrides)), scene_(sceneOf(tree_, overrides_)) {}

std::shared_ptr<SceneHandle> SceneHandle::with(const std::vector<std::string>& more) const {
  std::vector<std::string> overrides = overrides_;
  overrides.insert(overrides.end(), more.begin(), more.end());
  return std::make_shared<SceneHandle>(tree_, overrides);
}

std::string SceneHandle::toml() const {
  for (const BodySettings& body : scene_.simulation.bodies)
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape); mesh && mesh->given)
      throw InputError(
          fmt::format("scene: bodies.{}.shape.file: must be a file to be written down, and is a mesh in "
                      "memory: Mesh.save makes a file of it",
                      body.name));
  return writeScene(scene_);
}

std::shared_ptr<const RenderAssets> SceneHandle::assets() const {
  const std::lock_guard<std::mutex> alone(mutex_);
  if (!assets_) assets_ = std::make_shared<const RenderAssets>(scene_.render);
  return assets_;
}

namespace {

using Overrides = std::vector<std::string>;

std::shared_ptr<SceneHandle> ofDictionary(const py::dict& tables, const Overrides& overrides,
                                          const std::filesystem::path& directory) {
  return std::make_shared<SceneHandle>(treeOfDictionary(tables, directory), overrides);
}
std::shared_ptr<SceneHandle> ofFile(const std::filesystem::path& file, const Overrides& overrides) {
  return std::make_shared<SceneHandle>(readSceneTree(file), overrides);
}

}  // namespace

void bindScenes(py::module_& module) {
  py::class_<SceneHandle, std::shared_ptr<SceneHandle>>(module, "Scene",
                                                        "A scene, read and checked: the keys of docs/parameters.md.")
      .def(
          py::init(&ofDictionary), py::arg("tables"), py::arg("overrides") = Overrides{}, py::arg("directory") = ".",
          "Of a dictionary: the tables of a scene file, with lists or arrays for arrays and a Mesh where a mesh's "
          "file\n"
          "may stand. Relative files are named from `directory`. Raises SceneError with the text of `brisance check`,\n"
          "beginning with \"scene\" where that has file and line.")
      .def_static("load", &ofFile, py::arg("path"), py::arg("overrides") = Overrides{},
                  "Of a TOML file; `overrides` are \"key.path=value\" as the program's --set takes them.")
      .def("with_overrides", &SceneHandle::with, py::arg("overrides"), "The same scene with more overrides.")
      .def("toml", &SceneHandle::toml, "The scene as TOML, every default written out.")
      .def_property_readonly(
          "frames", [](const SceneHandle& s) { return s.scene().simulation.frames; }, "Frames of the film.")
      .def_property_readonly(
          "fps", [](const SceneHandle& s) { return s.scene().film.fps; }, "Frames of film per second.")
      .def_property_readonly(
          "frame_time", [](const SceneHandle& s) { return s.scene().simulation.frameTime; },
          "Simulated time between two frames [s].")
      .def_property_readonly(
          "seed", [](const SceneHandle& s) { return s.scene().simulation.seed; }, "Of all that is random.")
      .def_property_readonly(
          "picture_size",
          [](const SceneHandle& s) { return py::make_tuple(s.scene().render.width, s.scene().render.height); },
          "Width and height of a picture [pixels].")
      .def_property_readonly(
          "exposure_stops", [](const SceneHandle& s) { return s.scene().render.exposureStops; },
          "What pictures are brightened by for a screen [doublings].")
      .def_property_readonly(
          "inputs", [](const SceneHandle& s) { return s.scene().inputs; }, "Every file that the scene names.");
}

}  // namespace brisance::python
