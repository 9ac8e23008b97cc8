#include "particles/bits.h"

#include <gtest/gtest.h>

#include <set>

namespace brisance {
namespace {

/// Gas of one velocity in an open box of 40 m.
struct Wind {
  MacVelocity velocity{{4, 4, 4}, {-20, -20, -20}, 10};
  MacVelocity open = velocity;
  Grid3<float> temperature{{4, 4, 4}, {-15, -15, -15}, 10, 400.0f};
  explicit Wind(const Vec3d& wind) {
    for (int a = 0; a < 3; ++a) {
      auto& component = velocity.component(a).values;
      std::fill(component.begin(), component.end(), static_cast<float>(wind[a]));
      std::fill(open.component(a).values.begin(), open.component(a).values.end(), 1.0f);
    }
  }
  GasAround around() const { return {velocity, temperature, open}; }
};

TEST(Bits, FallAsFastAsABallOfTheirSizeInTheEnd) {
  const BitSettings grain{.3e-3, 2500, 1};
  Bits bits;
  addBit(bits, grain, {0, 10, 0}, {}, 300);
  const Wind still({0, 0, 0});
  for (int n = 0; n < 2000; ++n) stepBits(bits, still.around(), grain, {0, -9.81, 0}, 1e-3);
  // Weight against drag: 4/3 r density g = 0.45 / 2 1.2 v^2.
  const double terminal = std::sqrt(4.0 / 3 * .3e-3 * 2500 * 9.81 / (.5 * .45 * 1.2));
  ASSERT_EQ(bits.particles.size(), 1u);
  EXPECT_NEAR(bits.particles.velocity[0].y, -terminal, .01 * terminal);
  EXPECT_EQ(bits.particles.velocity[0].x, 0);
}

TEST(Bits, FallFreelyWhereTheyAreHeavy) {
  const BitSettings stone{10, 2500, 1};
  Bits bits;
  addBit(bits, stone, {0, 10, 0}, {1, 2, 0}, 300);
  const Wind still({0, 0, 0});
  for (int n = 0; n < 1000; ++n) stepBits(bits, still.around(), stone, {0, -9.81, 0}, 1e-3);
  EXPECT_NEAR(bits.particles.position[0].x, 1, 1e-3);
  EXPECT_NEAR(bits.particles.position[0].y, 10 + 2 - 9.81 / 2, 1e-2);
}

TEST(Bits, GoWithTheWindAndCoolToIt) {
  const BitSettings light{1e-6, 100, .25};
  Bits bits;
  addBit(bits, light, {0, 0, 0}, {}, 2400);
  const Wind wind({3, 0, -1});
  stepBits(bits, wind.around(), light, {0, 0, 0}, .25);
  EXPECT_LT(length(bits.particles.velocity[0] - Vec3d(3, 0, -1)), .01);
  EXPECT_NEAR(bits.particles.temperature[0], 400 + 2000 / std::exp(1), 1e-3);
}

TEST(Sparks, ComeOnceWhenTheirChargeDoes) {
  ParticleSettings settings;
  settings.charges.resize(2);
  settings.charges[0].sparks = 40;
  settings.charges[1].sparks = 20;
  settings.charges[1].time = .5;
  Bits sparks;
  throwSparks(sparks, settings, 0, 7);
  throwSparks(sparks, settings, .1, 7);
  EXPECT_EQ(sparks.particles.size(), 40u);
  for (const double time : {.6, .7}) throwSparks(sparks, settings, time, 7);
  EXPECT_EQ(sparks.particles.size(), 60u);
  const auto& ids = sparks.particles.id;
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), 60u);
}

TEST(Sparks, FlyOutwardsAtAThirdUpToAllOfTheirSpeed) {
  ParticleSettings settings;
  settings.charges.resize(1);
  Charge& charge = settings.charges[0];
  charge.position = {1, 2, 3};
  charge.sparks = 500;
  charge.sparkSpeed = 12;
  Bits sparks;
  throwSparks(sparks, settings, 0, 7);
  Vec3d sum;
  for (std::size_t n = 0; n < sparks.particles.size(); ++n) {
    const Vec3d velocity = sparks.particles.velocity[n], out = sparks.particles.position[n] - charge.position;
    EXPECT_GE(length(velocity), 4 - 1e-12);
    EXPECT_LE(length(velocity), 12 + 1e-12);
    EXPECT_LE(length(out), charge.radius);
    EXPECT_NEAR(dot(velocity, out), length(velocity) * length(out), 1e-9);
    EXPECT_EQ(sparks.particles.temperature[n], charge.sparkTemperature);
    sum += velocity;
  }
  EXPECT_LT(length(sum / 500.0), 1);  // to all sides: the mean of 500 has a deviation of 0.2 in each direction
}

}  // namespace
}  // namespace brisance
