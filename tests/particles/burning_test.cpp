#include "particles/burning.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "grid/interpolate.h"
#include "particles/particle_step.h"

namespace brisance {
namespace {

struct Box {
  MacVelocity velocity{{16, 16, 16}, {0, 0, 0}, 1.0 / 16};
  MacVelocity open = velocity;
  Grid3<float> temperature{{16, 16, 16}, Vec3d(.5, .5, .5) / 16.0, 1.0 / 16, 300.0f};
  Grid3<std::uint8_t> solid{{16, 16, 16}, Vec3d(.5, .5, .5) / 16.0, 1.0 / 16, 0};
  Box() {
    for (int a = 0; a < 3; ++a) std::fill(open.component(a).values.begin(), open.component(a).values.end(), 1.0f);
  }
  GasAround around() const { return {velocity, temperature, open}; }
};

/// What the first particle burnt.
double burnFirst(ParticleSet& p, const BurnSettings& s, double dt) {
  std::vector<double> burnt;
  burn(p, s, dt, burnt);
  return burnt[0];
}

ParticleSet oneFuel(const Vec3d& place, double mass, bool ignited) {
  ParticleSet p;
  append(p, {place, {}, mass, 300, ParticleKind::fuel, ignited});
  return p;
}

TEST(Burning, AParticleBurnsWhatItHasLeftAndNoMore) {
  BurnSettings s;
  ParticleSet p = oneFuel({.5, .5, .5}, s.burnRate * 0.025, true);
  double total = 0;
  for (int n = 0; n < 4; ++n) total += burnFirst(p, s, 0.01);
  EXPECT_NEAR(total, s.burnRate * 0.025, 1e-18);
  EXPECT_EQ(p.mass[0], 0);
  removeSpent(p, s, 0.01);
  EXPECT_EQ(p.size(), 0u);
}

TEST(Burning, IgnitionComesWithTheTemperatureOfTheGasAround) {
  Box box;
  BurnSettings s;
  s.thermalMass = 0;  // takes the gas' temperature at once
  ParticleSet p = oneFuel({.5, .5, .5}, s.mass, false);
  append(p, {{.5, .5, .5}, {}, s.mass, 300, ParticleKind::soot, false});
  const auto ignitedIn = [&](double temperature) {
    for (float& value : box.temperature.values) value = static_cast<float>(temperature);
    stepParticles(p, box.around(), s, 0.01);
    return p.ignited;
  };
  EXPECT_EQ(ignitedIn(s.ignitionTemperature - 1), (std::vector<std::uint8_t>{0, 0}));
  EXPECT_EQ(ignitedIn(s.ignitionTemperature), (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(ignitedIn(300), (std::vector<std::uint8_t>{1, 0}));  // what burns goes on
}

TEST(Burning, SootMassIsKept) {
  Box box;
  BurnSettings s;
  ParticleSet p = oneFuel({.5, .5, .5}, s.mass, true);
  double burnt = 0;
  while (p.size() > 0 && countBurning(p) > 0) {
    burnt += burnFirst(p, s, 0.01);
    createSoot(p, s, box.solid, 1);
    if (p.mass[0] == 0) break;
  }
  double soot = p.sootMass[0];
  for (std::size_t n = 1; n < p.size(); ++n) {
    EXPECT_EQ(p.kind[n], ParticleKind::soot);
    soot += p.mass[n];
  }
  EXPECT_NEAR(soot / (burnt * s.sootPerMass), 1, 1e-12);
  EXPECT_NEAR(static_cast<double>(p.size()), 1 + s.mass * s.sootPerMass / s.sootThreshold,
              1);  // the last may lack a rounding
}

TEST(Burning, TheThesisMakesOneSootParticlePerFuelParticle) {
  Box box;
  BurnSettings s;
  s.sootOnce = true;
  ParticleSet p = oneFuel({.5, .5, .5}, s.mass, true);
  for (int n = 0; n < 40; ++n) {
    burnFirst(p, s, 0.01);
    createSoot(p, s, box.solid, 1);
  }
  EXPECT_EQ(p.size(), 2u);
}

TEST(Emission, IsARateWhateverTheSteps) {
  ParticleSettings s;
  s.charges.push_back({{.5, .5, .5}, .1, 0.2, 100, 7, 1200, 0.5});
  ParticleSet coarse, fine;
  std::vector<std::uint64_t> a, b;
  emitFuel(coarse, s, 0.1, 300, 1, a);
  EXPECT_EQ(coarse.size(), 0u);
  emitFuel(coarse, s, 2, 300, 1, a);
  for (int n = 0; n <= 1000; ++n) emitFuel(fine, s, 0.002 * n, 300, 1, b);
  EXPECT_EQ(coarse.size(), 700u);
  EXPECT_EQ(coarse, fine);
  EXPECT_EQ(countBurning(coarse), 7u);
  for (const Vec3d& p : coarse.position) EXPECT_NEAR(length(p - Vec3d(.5, .5, .5)), .1, 1e-12);
}

TEST(Drag, IsExactForAnyStep) {
  const Vec3d gas{3, -1, 2}, start{0, 0.5, -4};
  Vec3d velocity = start, moved;
  for (int n = 0; n < 1000; ++n) {
    const Dragged step = dragExactly(velocity, gas, 40, 0.001);
    velocity = step.velocity;
    moved += step.displacement;
  }
  const Dragged once = dragExactly(start, gas, 40, 1.0);
  EXPECT_LT(length(once.velocity - velocity), 1e-12);
  EXPECT_LT(length(once.displacement - moved), 1e-12);
  const Dragged none = dragExactly(start, gas, 0, 1.0);
  EXPECT_LT(length(none.displacement - start), 1e-12);
}

TEST(Drag, TerminalVelocityIsTheGas) {
  Box box;
  for (float& v : box.velocity.v.values) v = 0.2f;
  BurnSettings s;
  ParticleSet p = oneFuel({.5, .1, .5}, s.mass, false);
  for (int n = 0; n < 100; ++n) stepParticles(p, box.around(), s, 0.02);
  ASSERT_EQ(p.size(), 1u);
  const double k = s.drag * s.radius * s.radius / s.mass;  // the lag decays as 1 / (1 + k |dv| t)
  EXPECT_NEAR(p.velocity[0].y, 0.2 - 0.2 / (1 + k * 0.2 * 2), 1e-6);
}

/// Gas that turns about the middle of the box and grows warmer upwards, and fuel and soot all over it.
struct Whirl {
  Box box;
  ParticleSet particles;
  BurnSettings settings;

  Whirl() {
    for (int axis = 0; axis < 3; ++axis) {
      Grid3<float>& component = box.velocity.component(axis);
      for (int k = 0; k < component.size.z; ++k)
        for (int j = 0; j < component.size.y; ++j)
          for (int i = 0; i < component.size.x; ++i) {
            const Vec3d away = component.position(i, j, k) - Vec3d(.5, .5, .5);
            component(i, j, k) = static_cast<float>((cross(Vec3d(1, 2, -1), away) + away * .5)[axis]);
          }
    }
    for (std::int64_t n = 0; n < box.temperature.count(); ++n) box.temperature.values[n] += static_cast<float>(n % 256);
    for (int j = 0; j < 8; ++j) box.open.u(9, j, 5) = 0;  // a wall
    const Random random(8, Stream::test);
    for (std::uint64_t n = 0; n < 6000; ++n) {
      NewParticle p;
      p.position = {random.uniform(8 * n), random.uniform(8 * n + 1), random.uniform(8 * n + 2)};
      p.velocity = Vec3d(random.uniform(8 * n + 3), random.uniform(8 * n + 4), -random.uniform(8 * n + 5));
      p.mass = settings.mass * random.uniform(8 * n + 6) * (n % 5 == 0 ? 1e-9 : 1);
      p.temperature = 300 + 1000 * random.uniform(8 * n + 7);
      p.kind = n % 3 == 0 ? ParticleKind::soot : ParticleKind::fuel;
      append(particles, p);
    }
  }
  ParticleSet after(double dt) const {
    ParticleSet moved = particles;
    stepParticles(moved, box.around(), settings, dt);
    return moved;
  }
};

TEST(ParticleStep, IsWhatEachParticleAloneWouldDo) {
  const Whirl whirl;
  const double dt = 0.02;
  const ParticleSet moved = whirl.after(dt);
  EXPECT_GT(moved.size(), 5000u);
  EXPECT_LT(moved.size(), 6000u);  // some leave the box
  const BurnSettings& s = whirl.settings;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    const std::uint64_t id = moved.id[n];
    const ParticleSet& before = whirl.particles;
    const bool fuel = before.kind[id] == ParticleKind::fuel;
    const Vec3d wind = interpolate(whirl.box.velocity, before.position[id]);
    Dragged exact{wind * dt, wind};
    if (before.mass[id] >= (fuel ? s.fuelMassThreshold : s.sootMassThreshold))
      exact = dragExactly(before.velocity[id], wind, s.drag * s.radius * s.radius / before.mass[id], dt);
    // Winds of a few m/s in single precision.
    ASSERT_LT(length(moved.velocity[n] - exact.velocity), 1e-6);
    const Vec3d goal = before.position[id] + exact.displacement;
    const bool wallNear = moved.position[n].x > 8.0 / 16 && moved.position[n].x < 10.0 / 16;
    ASSERT_TRUE(wallNear || length(moved.position[n] - goal) < 1e-6 * dt);
    const double around = interpolate(whirl.box.temperature, moved.position[n]);
    const double kept = std::exp(-dt * s.heating * s.radius * s.radius / s.thermalMass);
    ASSERT_NEAR(moved.temperature[n], around + (before.temperature[id] - around) * kept, 1e-3);
  }
}

TEST(ParticleStep, IsTheSameBitsOnAnyNumberOfThreadsAndVectors) {
  const Whirl whirl;
  const ParticleSet expected = whirl.after(0.02);
  const VectorPath before = vectorPath();
  for (const int threads : {1, 2, 5})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      EXPECT_EQ(whirl.after(0.02), expected);
    }
  forceVectorPath(before);
}

TEST(ParticleStep, OfAnEmptyBoxIsTheSameWithoutALookAtItsFaces) {
  Whirl whirl;
  for (Grid3<float>* component : {&whirl.box.open.u, &whirl.box.open.v, &whirl.box.open.w})
    std::fill(component->values.begin(), component->values.end(), 1.0f);
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 16; ++k) whirl.box.open.v(i, 0, k) = 0;  // the floor
  for (const Vec3d& place : {Vec3d(-.01, .5, .5), Vec3d(.5, 1.2, .5), Vec3d(2, .5, -2), Vec3d(.5, NAN, .5)})
    append(whirl.particles, {place, {1, -3, 0}, 1e-4, 300, ParticleKind::fuel, false});
  for (const bool periodic : {false, true})
    for (const double dt : {0.0, 0.02, 0.3}) {  // within a cell, to neighbours, beyond
      GasAround around = whirl.box.around();
      around.periodic = {periodic, false, periodic};
      ParticleSet looked = whirl.particles, trusted = whirl.particles;
      stepParticles(looked, around, whirl.settings, dt);
      around.empty = true;
      stepParticles(trusted, around, whirl.settings, dt);
      ASSERT_EQ(trusted.id, looked.id);
      for (std::size_t n = 0; n < looked.size(); ++n) {
        if (std::isnan(looked.position[n].y)) continue;
        ASSERT_EQ(trusted.position[n], looked.position[n]);
        ASSERT_EQ(trusted.velocity[n], looked.velocity[n]);
        ASSERT_EQ(trusted.temperature[n], looked.temperature[n]);
      }
    }
}

TEST(ParticleStep, DoesNothingWithoutParticles) {
  const Box box;
  ParticleSet none;
  stepParticles(none, box.around(), {}, 0.01);
  EXPECT_EQ(none.size(), 0u);
}

TEST(Walls, ThatLieElsewhereStopNoParticleFromOutsideTheBox) {
  Box box;
  for (float& u : box.velocity.u.values) u = 20;
  for (float& w : box.velocity.w.values) w = -5;
  for (int j = 0; j < 16; ++j)  // where a row beyond the last of a layer would lie in memory, and beyond the last layer
    for (int i = 0; i < 17; ++i) box.open.u(i, 0, 8) = box.open.u(i, j, 15) = 0;
  ParticleSet p = oneFuel({.1, 1.01, 7.5 / 16}, BurnSettings{}.mass, false);
  append(p, {{.1, .3, 1.01}, {20, 0, -5}, BurnSettings{}.mass, 300, ParticleKind::fuel, false});
  for (float& v : box.velocity.v.values) v = -2;
  p.velocity[0] = {20, -2, -5};
  stepParticles(p, box.around(), {}, 0.02);
  ASSERT_EQ(p.size(), 2u);
  EXPECT_NEAR(p.position[0].x, .5, 1e-6);
  EXPECT_LT(p.position[1].x, .126);  // the wall of the nearest layer holds
}

TEST(Soot, IsTheSameOnAnyNumberOfThreads) {
  const Box box;
  BurnSettings s;
  const auto made = [&](int threads) {
    const ThreadLimit limit(threads);
    ParticleSet p;
    for (int n = 0; n < 2000; ++n) append(p, {{.5, .5, .5}, {1, 0, 0}, s.mass, 300, ParticleKind::fuel, n % 2 == 0});
    for (int n = 0; n < 3; ++n) {
      burnFirst(p, s, 0.02);
      createSoot(p, s, box.solid, 1);
    }
    return p;
  };
  const ParticleSet expected = made(1);
  EXPECT_EQ(expected.size(), 2000u + 3000u);  // a thousand of them have burnt for three soot particles each
  for (const int threads : {2, 5}) EXPECT_EQ(made(threads), expected);
}

TEST(Heating, FollowsItsExponentialAndCoolsToo) {
  Box box;
  BurnSettings s;
  for (const double start : {300.0, 2000.0}) {
    std::fill(box.temperature.values.begin(), box.temperature.values.end(), 1000.0f);
    ParticleSet p = oneFuel({.5, .5, .5}, s.mass, false);
    p.temperature[0] = start;
    for (int n = 0; n < 5; ++n) stepParticles(p, box.around(), s, 0.01);
    const double rate = s.heating * s.radius * s.radius / s.thermalMass;
    EXPECT_NEAR(p.temperature[0], 1000 + (start - 1000) * std::exp(-rate * 0.05), 1e-6 * 1000);
  }
}

TEST(Walls, StopParticlesFromBothSides) {
  for (const float sign : {1.0f, -1.0f})
    for (int axis = 0; axis < 3; ++axis) {
      Box box;
      for (float& v : box.velocity.component(axis).values) v = 5 * sign;
      Grid3<float>& open = box.open.component(axis);
      for (int k = 0; k < open.size.z; ++k)
        for (int j = 0; j < open.size.y; ++j)
          for (int i = 0; i < open.size.x; ++i)
            if ((axis == 0 ? i : axis == 1 ? j : k) == 8) open(i, j, k) = 0;
      Vec3d start{.4, .4, .4};
      start[axis] = 0.5 - 0.2 * sign;
      BurnSettings s;
      ParticleSet p = oneFuel(start, s.mass, false);
      for (int n = 0; n < 50; ++n) stepParticles(p, box.around(), s, 0.02);
      ASSERT_EQ(p.size(), 1u);
      EXPECT_NEAR(p.position[0][axis], 0.5, 1e-6);
      EXPECT_EQ(p.position[0][axis]<0.5, sign> 0);
    }
}

TEST(Walls, LeavingTheBoxIsTheEnd) {
  Box box;
  for (float& v : box.velocity.u.values) v = -5;
  BurnSettings s;
  ParticleSet p = oneFuel({.1, .5, .5}, s.mass, false);
  for (int n = 0; n < 50; ++n) stepParticles(p, box.around(), s, 0.02);
  EXPECT_EQ(p.size(), 0u);
}

TEST(Walls, WhatLeavesAPeriodicBoxComesInAgainOpposite) {
  for (const float sign : {1.0f, -1.0f})
    for (int axis = 0; axis < 3; ++axis) {
      Box box;
      for (float& v : box.velocity.component(axis).values) v = 5 * sign;
      GasAround around = box.around();
      around.periodic[axis] = true;
      BurnSettings s;
      const Vec3d start{.41, .37, .63};
      ParticleSet p = oneFuel(start, s.fuelMassThreshold / 2, false);  // it moves as the gas does
      constexpr double dt = 0.013;
      for (int n = 1; n <= 60; ++n) {
        stepParticles(p, around, s, dt);
        ASSERT_EQ(p.size(), 1u) << axis << " " << n;
        Vec3d expected = start;
        expected[axis] += 5 * sign * dt * n;
        expected[axis] -= std::floor(expected[axis]);
        EXPECT_LT(length(p.position[0] - expected), 1e-9) << axis << " " << n;
      }
    }
}

TEST(Walls, AStepOfManyBoxesEndsWhereItShould) {
  Box box;
  for (float& v : box.velocity.v.values) v = -100;
  GasAround around = box.around();
  around.periodic[1] = true;
  BurnSettings s;
  ParticleSet p = oneFuel({.5, .25, .5}, s.fuelMassThreshold / 2, false);
  stepParticles(p, around, s, 0.0375);
  ASSERT_EQ(p.size(), 1u);
  EXPECT_NEAR(p.position[0].y, 0.5, 1e-9);
}

}  // namespace
}  // namespace brisance
