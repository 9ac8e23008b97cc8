// Snapshots: of a world, or from a run's files.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "bindings.h"
#include "frame/run_directory.h"

namespace brisance::python {
namespace {

using FramePointer = std::shared_ptr<const Frame>;

/// The bricks of a sparse grid as one array; the background where there is none.
template <class T>
py::array denseOf(const SparseGrid<T>& sparse) {
  auto owner = std::make_shared<Grid3<T>>(makeDense(sparse));
  if constexpr (std::is_same_v<T, float>) {
    return viewOf(*owner, owner);
  } else {
    const py::ssize_t number = sizeof(float), step = sizeof(T), row = step * sparse.size.x;
    return readOnly(&owner->values.front().x, {sparse.size.x, sparse.size.y, sparse.size.z, 3},
                    {step, row, row * sparse.size.y, number}, owner);
  }
}

/// A field of the particles, seen in place.
template <class Field>
auto particles(Field FrameParticles::*field) {
  return [field](const FramePointer& frame) { return viewOf(frame->particles.*field, frame); };
}

void bindBody(py::module_& module) {
  py::class_<FrameBody>(module, "FrameBody", "A body at a moment.")
      .def_readonly("name", &FrameBody::name, "Its own; of a piece that of its body and a number.")
      .def_readonly("material", &FrameBody::material, "Name of the scene's material.")
      .def_readonly("moves", &FrameBody::moves, "False: scenery.")
      .def_readonly("temperature", &FrameBody::temperature, "[K]")
      .def_property_readonly(
          "mesh", [](const FrameBody& body) { return Mesh{body.mesh}; }, "About the body's own origin.")
      .def_property_readonly(
          "position", [](const FrameBody& body) { return tupleOf(body.pose.position); }, "x, y, z of that origin [m].")
      .def_property_readonly(
          "orientation", [](const FrameBody& body) { return tupleOf(body.pose.orientation); },
          "Unit quaternion w, x, y, z that turns the mesh into place.")
      .def_property_readonly(
          "linear_velocity", [](const FrameBody& body) { return tupleOf(body.linearVelocity); }, "[m/s]")
      .def_property_readonly(
          "angular_velocity", [](const FrameBody& body) { return tupleOf(body.angularVelocity); }, "[1/s]");
}

void bindFrame(py::module_& module) {
  py::class_<Frame, std::shared_ptr<Frame>>(
      module, "Frame", "A moment, never changed. Arrays of particles are views; those of the gas are made anew.")
      .def_readonly("index", &Frame::index, "From 1.")
      .def_readonly("time", &Frame::time, "[s]")
      .def_readonly("bodies", &Frame::bodies, "All bodies, scenery too.")
      .def_property_readonly("particle_position", particles(&FrameParticles::position), "(n, 3) float32 [m]")
      .def_property_readonly("particle_velocity", particles(&FrameParticles::velocity), "(n, 3) float32 [m/s]")
      .def_property_readonly("particle_mass", particles(&FrameParticles::mass), "(n) float32 [kg]")
      .def_property_readonly("particle_temperature", particles(&FrameParticles::temperature), "(n) float32 [K]")
      .def_property_readonly("particle_kind", particles(&FrameParticles::kind),
                             "(n) uint8: 0 fuel that does not burn, 1 burning fuel, 2 soot.")
      .def_property_readonly(
          "temperature", [](const Frame& frame) { return denseOf(frame.gas.temperature); },
          "(nx, ny, nz) float32 [K] at cell centres.")
      .def_property_readonly(
          "density", [](const Frame& frame) { return denseOf(frame.gas.density); },
          "(nx, ny, nz) float32, soot [kg/m3] at cell centres.")
      .def_property_readonly(
          "flame", [](const Frame& frame) { return denseOf(frame.gas.flame); },
          "(nx, ny, nz) float32, fuel burnt of late [kg/m3] at cell centres.")
      .def_property_readonly(
          "velocity", [](const Frame& frame) { return denseOf(frame.gas.velocity); },
          "(nx, ny, nz, 3) float32 [m/s] at cell centres.");
}

/// A run directory, looked at.
struct RunHandle {
  std::filesystem::path path;
  std::shared_ptr<SceneHandle> scene;
};

RunHandle openRun(const std::filesystem::path& path) {
  RunReader run(path);  // refuses what is none
  return {path, std::make_shared<SceneHandle>(readSceneTree(path / "scene.toml"), std::vector<std::string>{})};
}

std::shared_ptr<Frame> readFrameOf(const RunHandle& run, int index) {
  const py::gil_scoped_release others;
  return std::make_shared<Frame>(readFrame(run.path, index, true));
}

void bindRun(py::module_& module) {
  py::class_<RunHandle>(module, "Run", "A run directory that the program has made, or is making.")
      .def(py::init(&openRun), py::arg("path"))
      .def_readonly("path", &RunHandle::path, "The run's directory.")
      .def_readonly("scene", &RunHandle::scene, "As it was run.")
      .def_property_readonly(
          "last_frame", [](const RunHandle& run) { return RunReader(run.path).lastFrame(); },
          "Frames 1 to this one are there whole, by now.")
      .def("frame", &readFrameOf, py::arg("index"), "A frame, its files' hashes checked.");
}

}  // namespace

void bindFrames(py::module_& module) {
  bindBody(module);
  bindFrame(module);
  bindRun(module);
}

}  // namespace brisance::python
