// Bodies whose vertices gas carries until they are released.
#include "rigid/swelling.h"

#include <gtest/gtest.h>

#include "mesh/mass_properties.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

/// Gas in a box of 1 m with some velocity at each place.
template <class Velocity>
MacVelocity gasOf(const Velocity& velocity) {
  MacVelocity gas({16, 16, 16}, {0, 0, 0}, 1.0 / 16);
  for (int axis = 0; axis < 3; ++axis) {
    Grid3<float>& speed = gas.component(axis);
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i)
          speed(i, j, k) = static_cast<float>(velocity(speed.position(i, j, k))[axis]);
  }
  return gas;
}

const Vec3d centre(.45, .5, .55);

TEST(Swelling, InAnEvenlySpreadingFlowABodyKeepsItsShapeAndGrowsExponentially) {
  constexpr double rate = 2, dt = 0.005;  // div u = 3 rate
  constexpr int steps = 40;
  const MacVelocity gas = gasOf([](const Vec3d& p) { return (p - centre) * rate; });
  const Pose pose{centre, axisAngle({0, .6, .8}, .7)};
  const TriangleMesh start = sphereMesh(.2, 16);
  TriangleMesh mesh = start;
  for (int n = 0; n < steps; ++n) mesh = carriedByGas(mesh, pose, gas, dt);
  const double growth = std::exp(rate * dt * steps);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)  // the midpoint rule is off by (rate dt)^3 / 6 a step
    EXPECT_LT(length(mesh.vertices[v] - start.vertices[v] * growth), 3e-5) << v;
  EXPECT_NEAR(solidProperties(mesh).volume / solidProperties(start).volume, std::pow(growth, 3), 1e-3);
  EXPECT_TRUE(mesh.normals.empty());
}

RigidBodies piece(const TriangleMesh& mesh, const Pose& pose, double mass) {
  RigidBodies bodies;
  bodies.name = {"piece"};
  bodies.position = {pose.position};
  bodies.orientation = {pose.orientation};
  bodies.linearVelocity = {Vec3d{}};
  bodies.angularVelocity = {Vec3d{}};
  bodies.inverseMass = {1 / mass};
  bodies.inertia = {Mat3{}};
  bodies.mesh = {std::make_shared<const TriangleMesh>(mesh)};
  bodies.area = {0};
  bodies.releaseTime = {0};
  return bodies;
}

TEST(Swelling, APieceThatGasTurnsLikeASolidGoesOnTurningSo) {
  const Vec3d velocity(.3, -.2, .1), spin(1, -2, .5);
  const MacVelocity gas = gasOf([&](const Vec3d& p) { return velocity + cross(spin, p - centre); });
  TriangleMesh shell = boxMesh({.3, .2, .1}, false);
  shell.triangles.resize(7);  // open, and its centroid is not its origin
  const Pose pose{centre, axisAngle({.6, 0, .8}, 1.1)};
  RigidBodies bodies = piece(shell, pose, 3);
  stiffen(bodies, 0, gas);
  const TriangleMesh& mesh = *bodies.mesh[0];
  const MassProperties properties = shellProperties(mesh, 1);
  EXPECT_LT(length(properties.centroid), 1e-12);
  EXPECT_NEAR(bodies.area[0], properties.area, 1e-12);
  const Pose now{bodies.position[0], bodies.orientation[0]};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_LT(length(now * mesh.vertices[v] - pose * shell.vertices[v]), 1e-12);
  EXPECT_LT(length(bodies.linearVelocity[0] - (velocity + cross(spin, bodies.position[0] - centre))), 1e-6);
  EXPECT_LT(length(bodies.angularVelocity[0] - spin), 1e-5);
}

}  // namespace
}  // namespace brisance
