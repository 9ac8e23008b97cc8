// Pieces that hold together, and what it takes to part them.
#include "rigid/bonds.h"

#include <gtest/gtest.h>

#include "rigid/colliding_bodies.h"

namespace brisance {
namespace {
using namespace test;

constexpr double side = .1, density = 1000;

/// Cubes in a row along x about the origin, each bonded to the next.
RigidBodies bar(int cubes, double strength, const Vec3d& middle = {}) {
  RigidBodies made;
  for (int n = 0; n < cubes; ++n)
    addBox(made, {side, side, side}, {middle + Vec3d(side * (n - (cubes - 1) / 2.), 0, 0), {}}, density);
  for (std::uint32_t& origin : made.origin) origin = 0;
  for (std::uint32_t n = 0; n + 1 < static_cast<std::uint32_t>(cubes); ++n)
    made.bonds.push_back({n, n + 1, {side / 2, 0, 0}, {1, 0, 0}, side * side, strength});
  made.holds.assign(made.bonds.size(), 1);
  return made;
}

std::vector<int> looseBonds(const RigidBodies& bodies) {
  std::vector<int> loose;
  for (std::size_t n = 0; n < bodies.holds.size(); ++n)
    if (!bodies.holds[n]) loose.push_back(static_cast<int>(n));
  return loose;
}

TEST(Bonds, APullAtBothEndsGoesThroughEveryBond) {
  const RigidBodies chain = bar(6, 1e9);
  std::vector<Load> loads(6);
  loads[0].push = {-3, 0, 0};
  loads[5].push = {3, 0, 0};
  for (const Load& passed : bondLoads(chain, loads)) {
    EXPECT_LT(length(passed.push - Vec3d(-3, 0, 0)), 1e-5);
    EXPECT_LT(length(passed.twist), 1e-5);
  }
}

TEST(Bonds, ALeverTwistsTheBondItIsFarFrom) {
  const RigidBodies chain = bar(2, 1e9);
  std::vector<Load> loads(2);
  loads[0].push = {0, -2, 0};  // a couple of 2 over one side's length, taken up by twists at the centres
  loads[1].push = {0, 2, 0};
  loads[0].twist = loads[1].twist = {0, 0, -side};
  const Load passed = bondLoads(chain, loads)[0];
  EXPECT_LT(length(passed.push - Vec3d(0, -2, 0)), 1e-5);
  EXPECT_LT(length(passed.twist), 1e-6) << "halfway between them there is no bending";
}

TEST(Bonds, AGroupMovesAsOneRigidBody) {
  RigidBodies made = bar(5, 1e12);
  for (std::size_t n = 0; n < made.size(); ++n) made.linearVelocity[n] = {1, .1 * static_cast<double>(n), 0};
  made.angularVelocity[2] = {40, 0, 5};
  Bench bench(made);
  bench.settings.gravity = {};
  const Vec3d linear = momentum(made), angular = angularMomentum(made);
  bench.run(1);
  for (std::size_t n = 1; n < made.size(); ++n) {
    EXPECT_NEAR(length(bench.bodies.position[n] - bench.bodies.position[n - 1]), side, 1e-12);
    EXPECT_LT(length(bench.bodies.angularVelocity[n] - bench.bodies.angularVelocity[0]), 1e-12);
  }
  EXPECT_LT(length(momentum(bench.bodies) - linear), 1e-12 * length(linear));
  EXPECT_LT(length(angularMomentum(bench.bodies) - angular), 1e-6 * length(angular));
}

TEST(Bonds, ASpinningBarPartsInTheMiddleWhenItsTensionPassesTheStrength) {
  // Tension over the middle of a bar of length L that turns at w: density w^2 L^2 / 8.
  constexpr int cubes = 8;
  constexpr double strength = 2e4, length0 = cubes * side;
  const double limit = std::sqrt(8 * strength / density) / length0;
  for (const double share : {.95, 1.05}) {
    RigidBodies made = bar(cubes, strength);
    for (std::size_t n = 0; n < made.size(); ++n) {
      made.angularVelocity[n] = {0, 0, share * limit};
      made.linearVelocity[n] = cross(made.angularVelocity[n], made.position[n]);
    }
    Bench bench(made);
    bench.dt = 1. / 2000;
    bench.settings.gravity = {};
    const Vec3d angular = angularMomentum(made);
    bench.run(.05);
    EXPECT_EQ(looseBonds(bench.bodies), share < 1 ? std::vector<int>{} : std::vector<int>{3}) << share;
    EXPECT_LT(length(momentum(bench.bodies)), 1e-9);
    EXPECT_LT(length(angularMomentum(bench.bodies) - angular), 1e-3 * length(angular));
  }
}

TEST(Bonds, ABarThatFallsOnARidgeBreaksOverIt) {
  for (const double strength : {2e6, 1e9}) {
    RigidBodies made = bar(8, strength, {0, .3, 0});
    addBox(made, {.02, .1, 1}, {{0, 0, 0}, {}}, 0);
    Bench bench(made);
    bench.run(.4);
    if (strength > 1e8)
      EXPECT_TRUE(looseBonds(bench.bodies).empty());
    else
      EXPECT_EQ(looseBonds(bench.bodies), std::vector<int>{3});
  }
}

TEST(Bonds, AHitKeepsMomentumWhetherOrNotItBreaks) {
  for (const double strength : {1e4, 1e9}) {
    RigidBodies made = bar(6, strength);
    addBox(made, {.1, .1, .1}, {{.2, .4, .02}, {}}, 5000);
    made.linearVelocity[6] = {0, -12, 0};
    Bench bench(made);
    bench.settings.gravity = {};
    const Vec3d linear = momentum(made), angular = angularMomentum(made);
    bench.run(.2);
    EXPECT_EQ(looseBonds(bench.bodies).empty(), strength > 1e6);
    EXPECT_LT(length(momentum(bench.bodies) - linear), 1e-9 * length(linear));
    EXPECT_LT(length(angularMomentum(bench.bodies) - angular), 1e-3 * length(angular));
  }
}

}  // namespace
}  // namespace brisance
