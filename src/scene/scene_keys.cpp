#include "scene/scene_keys.h"

namespace brisance {
namespace {

constexpr std::string_view qualityNames[] = {"none", "draft", "final"};

}  // namespace

void describeGeneral(KeyVisitor& v, SceneDraft& draft) {
  SimulationSettings& simulation = draft.scene.simulation;
  FilmSettings& film = draft.scene.film;
  visit(v, {"metres_per_unit", "m/unit", {1e-6, 1e6}, "length of one scene unit; every key in m counts in scene units"},
        draft.metresPerUnit);
  visitChoice(v, {"quality", "", anyValue, "preset of resolutions and samples; every key that is written overrides it"},
              qualityNames, draft.quality);
  visit(v, {"seed", "", atLeast(0), "of all random numbers of the simulation"}, simulation.seed);
  visit(v, {"frames", "", between(1, 9999), "length of the film"}, simulation.frames);
  visit(v, {"fps", "1/s", between(1, 1000), "frames of film per second"}, film.fps);
  visit(v, {"time_scale", "", above(0), "simulated seconds per second of film; below 1 is slow motion"},
        film.timeScale);
  visit(v, {"checkpoint_every", "", between(1, 9999), "frames between checkpoints, from which a run resumes"},
        simulation.checkpointEvery);
}

void describeScene(KeyVisitor& v, SceneDraft& draft) {
  SimulationSettings& simulation = draft.scene.simulation;
  visitTable(v, "scene", "the film as a whole", draft, describeGeneral);
  visitTable(v, "gas", "the gas, in a box of cubic cells", draft, describeGas);
  visitTable(v, "explosion", "fuel: how it burns and where it lies", simulation.particles, describeExplosion);
  visitTable(v, "rigid", "what moves bodies", simulation.rigid, describeRigid);
  visitArray(v, {"bodies", "", anyValue, "things: scenery, and what breaks and flies"}, draft.bodies, BodyKeys{},
             describeBody);
  visitTable(v, "camera", "the viewer", draft, describeCamera);
  visitArray(v, {"materials", "", anyValue, "looks, by name; \"plain\" exists unless it is declared"}, draft.materials,
             MaterialKeys{}, describeMaterial);
  visitArray(v, {"lights", "", anyValue, "what shines, besides fire and emissive materials"}, draft.scene.render.lights,
             Light{}, describeLight);
  visitTable(v, "render", "the picture", draft, describeRender);
  visitTable(v, "film", "the encoded film", draft.scene.film, [](KeyVisitor& inner, FilmSettings& film) {
    visit(inner, {"rate_factor", "", between(0, 51), "constant rate factor of the encoder: lower is better and larger"},
          film.rateFactor);
  });
}

void describeLattice(KeyVisitor& v, LatticeKeys& keys, Symbol cells) {
  // More cells than this along a side and one field alone passes 250 GB.
  constexpr Range side = between(1, 4096);
  visit(v, {"corner", "m", anyValue, "lower corner of the box", {}, "origin, or the gas box for the volume"},
        keys.corner);
  visit(v, {"size", "m", above(0), "of the box", {}, "cells times cell_size, or the longest side 1 m"}, keys.size);
  visit(v, {"cells", "", side, "along x, y, z", cells, "from size and cell_size or resolution"}, keys.cells);
  visit(v, {"cell_size", "m", above(0), "side of a cell", {}, "from size and cells or resolution"}, keys.cellSize);
  visit(v,
        {"resolution",
         "",
         side,
         "cells along the longest side, in place of cells and cell_size",
         {},
         "from scene.quality"},
        keys.resolution);
}

std::vector<ThesisVariable> thesisVariables() {
  return {{{"pos", "2.1"}, "ParticleSet position; starts on the sphere of explosion.charges"},
          {{"vel", "2.1"}, "ParticleSet velocity; starts at rest"},
          {{"Y", "2.1"}, "ParticleSet temperature; starts at gas.ambient_temperature"},
          {{"s", "2.1"}, "ParticleSet soot mass; starts at zero"},
          {{"H", "2.2"}, "FluidState heatRate, from the burning particles"},
          {{"p", "2.2"}, "FluidState pressure, from the projection"},
          {{"t", "2.2"}, "Frame time"},
          {{"T", "2.2"}, "FluidState temperature; starts at gas.ambient_temperature"},
          {{"u", "2.2"}, "FluidState velocity.u; starts at gas.start_velocity times random numbers"},
          {{"v", "2.2"}, "FluidState velocity.v; likewise"},
          {{"w", "2.2"}, "FluidState velocity.w; likewise"},
          {{"vel (body)", "3.1"}, "RigidBodies linearVelocity; starts at rest"},
          {{"omega", "3.1"}, "RigidBodies angularVelocity; starts at rest"},
          {{"I", "3.1"}, "RigidBodies inertia, from the shape and the mass"},
          {{"n_v", "3.1"}, "number of vertices of the body's mesh, from bodies.shape"},
          {{"verts", "3.1"}, "the body's mesh, from bodies.shape"}};
}

}  // namespace brisance
