// The world, stepped, and its arrays.
#include <pybind11/stl.h>

#include "world_handle.h"

namespace brisance::python {
namespace {

using WorldPointer = std::shared_ptr<WorldHandle>;

/// A part of a world; it has nothing of its own.
struct Gas {
  WorldPointer world;
};
struct Bodies {
  WorldPointer world;
};
struct Particles {
  WorldPointer world;
};

template <class Field>
auto gas(Field FluidState::*field) {
  return [field](const Gas& gas) { return gas.world->lend(gas.world->state().gas.*field); };
}
auto faces(Grid3<float> MacVelocity::*component) {
  return [component](const Gas& gas) { return gas.world->lend(gas.world->state().gas.velocity.*component); };
}
template <class Field>
auto bodies(Field RigidBodies::*field) {
  return [field](const Bodies& bodies) { return bodies.world->lend(bodies.world->state().bodies.*field); };
}
template <class Field>
auto particles(Field ParticleSet::*field) {
  return [field](const Particles& p) { return p.world->lend(p.world->state().particles.*field); };
}

const FluidSettings& boxOf(const Gas& gas) { return gas.world->scene().scene().simulation.fluid; }

void bindGas(py::module_& module) {
  py::class_<Gas>(
      module, "Gas",
      "The gas of a world. Arrays are views of (nx, ny, nz) float32, indexed [i, j, k]; sample (i, j, k) lies\n"
      "at corner + (i + 0.5, j + 0.5, k + 0.5) * cell_size. They show the moment that they were taken at,\n"
      "also after the world has gone on.")
      .def_property_readonly(
          "cells", [](const Gas& g) { return tupleOf(boxOf(g).cells); }, "nx, ny, nz")
      .def_property_readonly(
          "cell_size", [](const Gas& g) { return boxOf(g).cellSize; }, "[m]")
      .def_property_readonly(
          "corner", [](const Gas& g) { return tupleOf(boxOf(g).corner); }, "x, y, z of the box's lower corner [m].")
      .def_property_readonly("temperature", gas(&FluidState::temperature), "[K]")
      .def_property_readonly("soot", gas(&FluidState::soot), "[kg/m3]")
      .def_property_readonly("flame", gas(&FluidState::flame), "Fuel burnt of late [kg/m3].")
      .def_property_readonly("pressure", gas(&FluidState::pressure), "Over the density [m2/s2].")
      .def_property_readonly("divergence", gas(&FluidState::divergence), "Rate of expansion [1/s].")
      .def_property_readonly("heat_rate", gas(&FluidState::heatRate), "[K/s]")
      .def_property_readonly("u", faces(&MacVelocity::u),
                             "Velocity along x [m/s], (nx + 1, ny, nz): u[i, j, k] on the face below cell i.")
      .def_property_readonly("v", faces(&MacVelocity::v), "Velocity along y [m/s], (nx, ny + 1, nz).")
      .def_property_readonly("w", faces(&MacVelocity::w), "Velocity along z [m/s], (nx, ny, nz + 1).");
}

Mesh meshOf(const Bodies& bodies, std::size_t index) {
  const RigidBodies& all = bodies.world->state().bodies;
  if (index >= all.size()) throw py::index_error(fmt::format("body {} of {}", index, all.size()));
  return {all.mesh[index]};
}

void bindBodies(py::module_& module) {
  py::class_<Bodies>(
      module, "Bodies",
      "The bodies of a world, scenery too. Arrays are float64 views with a row for each body; they show\n"
      "the moment that they were taken at.")
      .def("__len__", [](const Bodies& b) { return b.world->state().bodies.size(); })
      .def_property_readonly(
          "names", [](const Bodies& b) { return b.world->state().bodies.name; }, "A list of texts.")
      .def_property_readonly("position", bodies(&RigidBodies::position), "(n, 3) centres of mass [m]")
      .def_property_readonly("orientation", bodies(&RigidBodies::orientation), "(n, 4) unit quaternions w, x, y, z")
      .def_property_readonly("linear_velocity", bodies(&RigidBodies::linearVelocity), "(n, 3) [m/s]")
      .def_property_readonly("angular_velocity", bodies(&RigidBodies::angularVelocity),
                             "(n, 3) [1/s] in the world's axes")
      .def_property_readonly("inverse_mass", bodies(&RigidBodies::inverseMass), "(n) [1/kg]; 0: immovable")
      .def("mesh", &meshOf, py::arg("index"), "The mesh of a body, about its centre of mass.");
}

void bindParticles(py::module_& module) {
  py::class_<Particles>(
      module, "Particles",
      "Fuel and soot. Arrays are views with an entry for each particle; they show the moment that they\n"
      "were taken at. A step may add particles, drop some and change their order: `id` tells them.")
      .def("__len__", [](const Particles& p) { return p.world->state().particles.size(); })
      .def_property_readonly("id", particles(&ParticleSet::id), "(n) uint64")
      .def_property_readonly("position", particles(&ParticleSet::position), "(n, 3) float64 [m]")
      .def_property_readonly("velocity", particles(&ParticleSet::velocity), "(n, 3) float64 [m/s]")
      .def_property_readonly("mass", particles(&ParticleSet::mass), "(n) float64 [kg]")
      .def_property_readonly("temperature", particles(&ParticleSet::temperature), "(n) float64 [K]")
      .def_property_readonly("kind", particles(&ParticleSet::kind), "(n) uint8: 0 fuel, 1 soot")
      .def_property_readonly("ignited", particles(&ParticleSet::ignited), "(n) uint8: 1 burns, or has burnt");
}

py::dict dictionaryOf(const Balance& balance) {
  return py::dict(py::arg("in") = balance.in, py::arg("gained") = balance.gained, py::arg("out") = balance.out,
                  py::arg("lost") = balance.lost, py::arg("error") = balance.error());
}

py::dict reportOf(WorldHandle& world) {
  const StepReport& report = world.state().report;
  return py::dict(
      py::arg("substeps") = report.substeps, py::arg("courant") = report.courant,
      py::arg("divergence") = report.divergence, py::arg("pressure_iterations") = report.pressure.iterations,
      py::arg("pressure_residual") = report.pressure.residual, py::arg("volume") = dictionaryOf(report.volume),
      py::arg("heat") = dictionaryOf(report.heat), py::arg("stage_seconds") = report.stageSeconds);
}

bool isFalse(const py::object& answer) { return py::isinstance<py::bool_>(answer) && !py::cast<bool>(answer); }

void run(const WorldPointer& world, const py::object& callback, std::optional<int> lastFrame) {
  const int last = lastFrame.value_or(world->scene().scene().simulation.frames);
  while (world->state().frame < last) {
    world->step();
    if (!callback.is_none() && isFalse(callback(world))) return;
  }
}

py::array render(WorldHandle& world, std::optional<int> width, std::optional<int> height, std::optional<double> samples,
                 bool alpha) {
  return pictureOf(world.scene(), *world.capture(), {width, height, samples, alpha});
}

}  // namespace

void bindWorlds(py::module_& module) {
  bindGas(module);
  bindBodies(module);
  bindParticles(module);
  py::class_<WorldHandle, WorldPointer>(module, "World", "Everything of a scene that moves, at a moment.")
      .def(py::init<std::shared_ptr<SceneHandle>>(), py::arg("scene"),
           "Breaks the scene's bodies and lays out gas and particles; this is frame 1. Ctrl-C cuts it.")
      .def("step", &WorldHandle::step,
           "Simulate one frame. Other threads run meanwhile. Ctrl-C cuts it in its middle; the world is then what it "
           "was\n"
           "before the call. Raises UnstableError.")
      .def(
          "run", &run, py::arg("callback") = py::none(), py::arg("last_frame") = py::none(),
          "Step up to a frame, by default the scene's last, and call `callback(world)` after each step; it may return\n"
          "False to stop.")
      .def("capture", &WorldHandle::capture, "The moment as a Frame, as it would be written to a run.")
      .def("render", &render, py::kw_only(), py::arg("width") = py::none(), py::arg("height") = py::none(),
           py::arg("samples") = py::none(), py::arg("alpha") = false, "The picture of the moment: see `render`.")
      .def_property_readonly("scene", &WorldHandle::sharedScene, "What it was made of.")
      .def_property_readonly(
          "frame", [](WorldHandle& world) { return world.state().frame; }, "The number of the moment's frame, from 1.")
      .def_property_readonly(
          "time", [](WorldHandle& world) { return world.state().time; }, "Simulated [s].")
      .def_property_readonly("report", &reportOf, "What the last step has to say for itself: a dictionary.")
      .def_property_readonly(
          "gas", [](const WorldPointer& world) { return Gas{world}; }, "Its gas, now.")
      .def_property_readonly(
          "bodies", [](const WorldPointer& world) { return Bodies{world}; }, "Its bodies, now.")
      .def_property_readonly(
          "particles", [](const WorldPointer& world) { return Particles{world}; }, "Its particles, now.");
}

}  // namespace brisance::python
