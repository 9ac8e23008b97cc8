#include "particles/burning.h"

#include <gtest/gtest.h>

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

TEST(Burning, IgnitionComesWithTemperature) {
  BurnSettings s;
  ParticleSet p = oneFuel({.5, .5, .5}, s.mass, false);
  ignite(p, s);
  EXPECT_FALSE(p.ignited[0]);
  p.temperature[0] = s.ignitionTemperature;
  ignite(p, s);
  EXPECT_TRUE(p.ignited[0]);
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

}  // namespace
}  // namespace brisance
