// A small explosion behind a pane in a wall.
#pragma once

#include "simulation/simulation_settings.h"

namespace brisance::test {

inline BodySettings wallPart(const std::string& name, const Vec3d& lower, const Vec3d& upper) {
  BodySettings wall;
  wall.name = name;
  wall.shape = BoxShape{upper - lower};
  wall.pose.position = (lower + upper) * 0.5;
  wall.moves = false;
  wall.blocksGas = true;
  return wall;
}

inline SimulationSettings smallScene() {
  SimulationSettings s;
  s.frames = 12;
  s.fluid.cells = {14, 14, 14};
  s.fluid.cellSize = 1.0 / 14;
  s.fluid.startVelocity = 1e-3;
  s.fluid.buoyancy = 0.01;
  s.fluid.vorticityConfinement = 0.5;
  s.particles.burning.heating = 75000;
  s.particles.burning.depositRadius = 0.08;
  s.particles.charges = {{{.5, .5, .35}, .1, 0, 300, 150, 1200, .1}, {{.4, .6, .3}, .05, .15, 50, 50, 0, 0}};
  s.rigid.push = Drag{300, {}, false, 0};
  s.bodies = {wallPart("left", {-.2, -.2, .6}, {.35, 1.2, .7}), wallPart("right", {.65, -.2, .6}, {1.2, 1.2, .7}),
              wallPart("below", {.35, -.2, .6}, {.65, .3, .7}), wallPart("above", {.35, .7, .6}, {.65, 1.2, .7})};
  BodySettings pane;
  pane.name = "pane";
  PaneSettings glass;
  glass.outline = RectangleOutline{.3, .4};
  glass.thickness = .005;
  glass.points = 60;
  pane.shape = glass;
  pane.fracture.pieces = 6;
  pane.pose.position = {.5, .5, .65};
  pane.material = "glass";
  s.bodies.push_back(pane);
  return s;
}

/// The same, the pieces in the way of the gas and pushed by its pressure.
inline SimulationSettings blockingScene() {
  SimulationSettings s = smallScene();
  s.bodiesInGas = BodiesInGas::block;
  s.rigid.push = Pressure{};
  return s;
}

/// A pane's pieces fall in a heap on the floor of the box, without an explosion.
inline SimulationSettings landingScene() {
  SimulationSettings s = smallScene();
  s.particles.charges.clear();
  s.rigid.collisions = Contacts{};
  BodySettings floor = wallPart("floor", {-3, -.1, -3}, {4, 0, 4});
  floor.blocksGas = false;
  s.bodies.push_back(floor);
  BodySettings& pane = s.bodies[4];
  pane.pose = {{.5, .25, .4}, axisAngle(normalized(Vec3d(1, .2, .3)), .5)};
  return s;
}

}  // namespace brisance::test
