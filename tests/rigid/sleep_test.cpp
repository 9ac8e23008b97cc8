// What has come to rest, and what wakes it.
#include <gtest/gtest.h>

#include "rigid/colliding_bodies.h"

namespace brisance {
namespace {
using namespace test;

constexpr double side = .2;

/// Boxes on the floor, one on another.
RigidBodies stack(int boxes) {
  RigidBodies made;
  addFloor(made);
  for (int n = 0; n < boxes; ++n) addBox(made, {side, side, side}, {{0, side * (n + .5) + 1e-4, 0}, {}});
  return made;
}

bool isAsleep(const Bench& bench, std::size_t body) { return bench.bodies.rest[body].heap != 0; }

TEST(Sleep, AStackFallsAsleepTogether) {
  Bench bench(stack(3));
  bench.run(.4);
  for (std::size_t b = 1; b <= 3; ++b) EXPECT_FALSE(isAsleep(bench, b)) << b;
  bench.run(.6);
  for (std::size_t b = 1; b <= 3; ++b) EXPECT_EQ(bench.bodies.rest[b].heap, bench.bodies.rest[1].heap) << b;
  EXPECT_TRUE(isAsleep(bench, 1));
}

TEST(Sleep, AStruckBoxMovesAsIfItHadBeenAwake) {
  std::vector<RigidBodies> ends;
  for (const double waits : {.1, 1.}) {
    RigidBodies made = stack(1);
    addBox(made, {side, side, side}, {{-1, 5, 0}, {}});
    Bench bench(made);
    bench.run(waits);
    EXPECT_EQ(isAsleep(bench, 1), waits > .5);
    bench.bodies.position[2] = {-.3, side / 2 + 1e-4, 0};
    bench.bodies.orientation[2] = {};
    bench.bodies.linearVelocity[2] = {3, 0, 0};
    bench.bodies.angularVelocity[2] = {};
    bench.run(.2);
    ends.push_back(bench.bodies);
  }
  EXPECT_GT(ends[0].position[1].x, .1);
  EXPECT_LT(length(ends[0].position[1] - ends[1].position[1]), 1e-4);
  EXPECT_LT(length(ends[0].linearVelocity[1] - ends[1].linearVelocity[1]), 1e-2);
}

TEST(Sleep, WhatLayOnABoxThatIsKnockedAwayFalls) {
  Bench bench(stack(2));
  bench.run(1);
  ASSERT_TRUE(isAsleep(bench, 2));
  bench.bodies.linearVelocity[1] = {6, 0, 0};
  bench.run(1.5);
  EXPECT_LT(bench.bodies.position[2].y, .6 * side);
}

TEST(Sleep, WhatLayOnSomethingHeldFallsWhenThatIsReleased) {
  RigidBodies made;
  addBox(made, {1, .2, 1}, {{0, 2, 0}, {}});
  addBox(made, {side, side, side}, {{0, 2.1 + side / 2 + 1e-4, 0}, {}});
  made.releaseTime[0] = 1.5;
  Bench bench(made);
  bench.run(2.5);
  EXPECT_LT(bench.bodies.position[1].y, -2);
}

TEST(Sleep, WhatLandsOnASleepingStackWakesItAndAGrainDoesNot) {
  for (const double size : {.01, .15}) {
    RigidBodies made = stack(2);
    addBox(made, {size, size, size}, {{0, 2 * side + size / 2 + .002, 0}, {}});
    made.releaseTime[3] = 1;
    Bench bench(made);
    bench.run(1.2);
    EXPECT_EQ(isAsleep(bench, 1), size < .1) << size;
    bench.run(1);
    EXPECT_TRUE(isAsleep(bench, 3)) << size;
    EXPECT_EQ(bench.bodies.rest[3].heap, bench.bodies.rest[1].heap) << "they wake together now";
  }
}

TEST(Sleep, AGustWakesABreathDoesNot) {
  for (const double push : {.05, 3.}) {  // of the weight
    Bench bench(stack(1));
    bench.run(1);
    const Vec3d there = bench.bodies.position[1];
    for (int n = 0; n < 60; ++n) {
      bench.bodies.linearVelocity[1] += Vec3d(push * 9.81 * bench.dt, 0, 0);
      bench.step();
    }
    if (push < 1)
      EXPECT_EQ(bench.bodies.position[1], there);
    else
      EXPECT_GT(bench.bodies.position[1].x, .1);
  }
}

TEST(Sleep, WithoutWeightNothingFallsAsleep) {
  Bench bench(stack(2));
  bench.settings.gravity = {};
  bench.run(1);
  EXPECT_FALSE(isAsleep(bench, 1));
}

}  // namespace
}  // namespace brisance
