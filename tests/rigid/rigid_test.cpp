#include <gtest/gtest.h>

#include "mesh/mass_properties.h"
#include "mesh/shapes.h"
#include "rigid/gas_push.h"
#include "rigid/rigid_step.h"

namespace brisance {
namespace {

RigidBodies boxBody(const Vec3d& size, double density, const Vec3d& place = {.5, .5, .5}) {
  RigidBodies b;
  auto mesh = std::make_shared<TriangleMesh>(boxMesh(size, false));
  const MassProperties m = solidProperties(*mesh);
  b.name = {"box"};
  b.position = {place};
  b.orientation = {Quaternion{}};
  b.linearVelocity = {Vec3d{}};
  b.angularVelocity = {Vec3d{}};
  b.inverseMass = {1 / (m.volume * density)};
  b.inertia = {m.inertia * density};
  b.mesh = {mesh};
  b.area = {m.area};
  b.releaseTime = {0};
  return b;
}

MacVelocity wind(const Vec3d& v) {
  MacVelocity gas({16, 16, 16}, {0, 0, 0}, 1.0 / 16);
  for (int a = 0; a < 3; ++a)
    std::fill(gas.component(a).values.begin(), gas.component(a).values.end(), static_cast<float>(v[a]));
  return gas;
}

TEST(Rigid, FreeFallIsExact) {
  RigidBodies b = boxBody({.1, .1, .1}, 1000);
  const RigidSettings s;
  for (int n = 0; n < 100; ++n) stepBodies(b, s, 0.01 * n, 0.01);
  EXPECT_NEAR(b.position[0].y, 0.5 - 0.5 * 9.81, 1e-10);
  EXPECT_NEAR(b.linearVelocity[0].y, -9.81, 1e-10);
}

TEST(Rigid, ATorqueFreeTopKeepsItsMomentumAndEnergy) {
  RigidBodies b = boxBody({.1, .2, .4}, 1000);
  b.angularVelocity[0] = {0.1, 6, 0.2};  // about the middle axis: it tumbles
  RigidSettings s;
  s.gravity = {};
  const auto momentum = [&] { return worldInertia(b.inertia[0], b.orientation[0]) * b.angularVelocity[0]; };
  const Vec3d start = momentum();
  const double energy = dot(start, b.angularVelocity[0]);
  bool flipped = false;
  for (int n = 0; n < 2000; ++n) {
    stepBodies(b, s, 0.005 * n, 0.005);
    flipped = flipped || rotate(b.orientation[0], {0, 1, 0}).y < -0.5;
  }
  EXPECT_TRUE(flipped);
  EXPECT_LT(length(momentum() - start), 1e-9 * length(start));
  EXPECT_NEAR(dot(momentum(), b.angularVelocity[0]) / energy, 1, 1e-5);
}

TEST(Rigid, ASymmetricTopPrecessesWithItsPeriod) {
  // Body cone of a symmetric top: omega turns about the axis at (I3 - I1) / I1 omega3 in the body's frame.
  RigidBodies b = boxBody({.2, .2, .05}, 1000);
  b.angularVelocity[0] = {0.5, 0, 10};
  RigidSettings s;
  s.gravity = {};
  const double i1 = b.inertia[0].row[0].x, i3 = b.inertia[0].row[2].z;
  const double period = 2 * pi / std::abs((i3 - i1) / i1 * 10);
  const int steps = 4000;
  for (int n = 0; n < steps; ++n) stepBodies(b, s, 0, period / steps);
  const Vec3d omega = rotate(conjugate(b.orientation[0]), b.angularVelocity[0]);
  EXPECT_NEAR(omega.x, 0.5, 1e-6);
  EXPECT_NEAR(omega.y, 0, 1e-5);
}

TEST(Rigid, StepHalvingConvergesAtFourthOrder) {
  const auto orientationAfter = [](int steps) {
    RigidBodies b = boxBody({.1, .2, .4}, 1000);
    b.angularVelocity[0] = {3, 2, 1};
    RigidSettings s;
    s.gravity = {};
    for (int n = 0; n < steps; ++n) stepBodies(b, s, 0, 1.0 / steps);
    return b.orientation[0];
  };
  const auto difference = [](const Quaternion& a, const Quaternion& b) {
    return std::abs(a.w - b.w) + std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
  };
  const Quaternion fine = orientationAfter(640);
  EXPECT_GT(difference(orientationAfter(20), fine) / difference(orientationAfter(40), fine), 12);
}

TEST(GasPush, ABodyComesToTheSpeedOfTheWindAndNeverBeyond) {
  for (const double sign : {1.0, -1.0}) {
    RigidBodies b = boxBody({.1, .1, .1}, 10);
    Drag push;
    push.forceConstant = 30;
    const MacVelocity gas = wind({0, 0, 2 * sign});
    double last = 0;
    for (int n = 0; n < 400; ++n) {
      b.position[0] = {.5, .5, .5};
      pushBodies(b, gas, push, 0, 0.05);
      EXPECT_GE(sign * b.linearVelocity[0].z, last - 1e-12);
      EXPECT_LE(sign * b.linearVelocity[0].z, 2 + 1e-9);
      last = sign * b.linearVelocity[0].z;
    }
    EXPECT_NEAR(last, 2, 0.02);
    EXPECT_LT(length(b.angularVelocity[0]), 1e-9);
  }
}

TEST(GasPush, AFinerMeshIsPushedTheSame) {
  RigidBodies coarse = boxBody({.2, .1, .05}, 100), fine = coarse;
  TriangleMesh mesh = *coarse.mesh[0];
  for (int round = 0; round < 2; ++round) {
    TriangleMesh split;
    split.vertices = mesh.vertices;
    for (const Triangle& t : mesh.triangles) {
      const auto centre = static_cast<std::uint32_t>(split.vertices.size());
      split.vertices.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0);
      for (int e = 0; e < 3; ++e) split.triangles.push_back({t[e], t[(e + 1) % 3], centre});
    }
    mesh = split;
  }
  fine.mesh[0] = std::make_shared<const TriangleMesh>(mesh);
  const MacVelocity gas = wind({1, 0.5, -2});
  pushBodies(coarse, gas, {}, 0, 0.1);
  pushBodies(fine, gas, {}, 0, 0.1);
  EXPECT_LT(length(coarse.linearVelocity[0] - fine.linearVelocity[0]), 1e-9);
}

TEST(GasPush, TheThesisSumPushesAFinerMeshHarder) {
  RigidBodies b = boxBody({.2, .1, .05}, 100);
  for (auto* field : {&b.position, &b.linearVelocity, &b.angularVelocity}) field->push_back((*field)[0]);
  b.orientation.push_back({});
  b.inverseMass.push_back(b.inverseMass[0]);
  b.inertia.push_back(b.inertia[0]);
  b.area.push_back(b.area[0]);
  b.releaseTime.push_back(0);
  TriangleMesh fine = *b.mesh[0];
  for (int copy = 0; copy < 8; ++copy) fine.vertices.push_back(fine.vertices[copy]);
  b.mesh.push_back(std::make_shared<const TriangleMesh>(fine));
  Drag thesis;
  thesis.quadrature = VertexSum{};
  pushBodies(b, wind({0, 0, 1}), thesis, 0, 0.01);
  EXPECT_NEAR(b.linearVelocity[1].z / b.linearVelocity[0].z, 2, 0.1);
}

TEST(GasPush, AShearTurnsABodyTheRightWay) {
  MacVelocity gas = wind({0, 0, 0});
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i <= 16; ++i) gas.u(i, j, k) = static_cast<float>(gas.u.position(i, j, k).y - .5);
  RigidBodies b = boxBody({.2, .2, .2}, 1);
  Drag push;
  push.forceConstant = 100;
  for (int n = 0; n < 200; ++n) pushBodies(b, gas, push, 0, 0.05);
  EXPECT_LT(b.angularVelocity[0].z, -0.1);  // faster above: it rolls about -z
  EXPECT_NEAR(b.angularVelocity[0].x, 0, 1e-6);
}

TEST(GasPush, OnlyTheParallelForceIsTheThesisChoice) {
  RigidBodies whole = boxBody({.3, .1, .02}, 100), parallel = whole;
  Drag push;
  const MacVelocity gas = wind({0, 0, 1});
  pushBodies(whole, gas, push, 0, 0.1);
  push.parallelOnly = true;
  pushBodies(parallel, gas, push, 0, 0.1);
  EXPECT_GT(parallel.linearVelocity[0].z, 0);
  EXPECT_LT(parallel.linearVelocity[0].z, 0.5 * whole.linearVelocity[0].z);
}

TEST(GasPush, HeldAndImmovableBodiesStay) {
  RigidBodies b = boxBody({.1, .1, .1}, 1);
  b.releaseTime[0] = 1;
  const MacVelocity gas = wind({5, 5, 5});
  pushBodies(b, gas, {}, 0.5, 0.1);
  stepBodies(b, {}, 0.5, 0.1);
  EXPECT_EQ(b.linearVelocity[0], Vec3d());
  EXPECT_EQ(b.position[0], Vec3d(.5, .5, .5));
  pushBodies(b, gas, {}, 1.0, 0.1);
  EXPECT_GT(b.linearVelocity[0].x, 0);
}

TEST(GasPush, OutsideTheBoxNothingPushes) {
  RigidBodies b = boxBody({.1, .1, .1}, 1, {2, .5, .5});
  pushBodies(b, wind({5, 5, 5}), {}, 0, 0.1);
  EXPECT_EQ(b.linearVelocity[0], Vec3d());
}

}  // namespace
}  // namespace brisance
