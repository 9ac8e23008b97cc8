#include "render/fire_directions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/sample_sequence.h"
#include "render/scattering.h"

using namespace brisance;

namespace {

/// Fire in two opposite corners of a cube of 2 m about the origin, one twice as bright.
GasMedium twoFires() {
  VolumeSettings settings;
  settings.blur = 0;
  settings.fullDensity = 1;
  settings.opacity = 6;
  const Vec3d first(-0.95, -0.95, -0.95);
  ParticleVolume volume{Grid3<float>({20, 20, 20}, first, 0.1), Grid3<Vec3f>({20, 20, 20}, first, 0.1)};
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) {
        volume.density(i, j, k) = volume.density(19 - i, 19 - j, 19 - k) = 1;
        volume.colour(i, j, k) = {4, 2, 1};
        volume.colour(19 - i, 19 - j, 19 - k) = {2, 1, 0.5f};
      }
  return {volume, settings};
}

struct Place {
  Vec3f at, normal;
};
const Place places[] = {{{3, 0.5f, 0.2f}, {}},          // outside, from all around
                        {{3, 0.5f, 0.2f}, {-1, 0, 0}},  // on a wall that faces the fire
                        {{1.2f, 0.1f, 0}, {0, 1, 0}},   // on a floor between both
                        {{-0.7f, -0.6f, -0.7f}, {}},    // in the fire
                        {{0.7f, 0.7f, 0.7f}, {0, -1, 0}}};

}  // namespace

TEST(FireCones, DensityIntegratesToOne) {
  const GasMedium gas = twoFires();
  const FireDirections fire(gas);
  for (const Place& place : places) {
    const FireCones cones(fire, place.at, place.normal);
    ASSERT_FALSE(cones.isDark());
    constexpr int rows = 600;
    double sum = 0;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < 2 * rows; ++column)
        sum += cones.density(samplePhase(0, {0, 0, 1}, (static_cast<float>(row) + 0.5f) / rows,
                                         (static_cast<float>(column) + 0.5f) / (2 * rows)));
    EXPECT_NEAR(sum * 4 * pi / (2 * rows * rows), 1, 0.01);
  }
}

// Of a half of all directions as many are drawn as the density says.
TEST(FireCones, DrawsByItsDensity) {
  const GasMedium gas = twoFires();
  const FireDirections fire(gas);
  for (const Place& place : places) {
    const FireCones cones(fire, place.at, place.normal);
    constexpr int draws = 100000, rows = 300;
    double upper = 0, drawnUpper = 0;  // of the half of directions with y > 0.3 x
    const auto isUpper = [](const Vec3f& direction) { return direction.y > 0.3f * direction.x; };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < 2 * rows; ++column) {
        const Vec3f direction = samplePhase(0, {0, 0, 1}, (static_cast<float>(row) + 0.5f) / rows,
                                            (static_cast<float>(column) + 0.5f) / (2 * rows));
        if (isUpper(direction)) upper += cones.density(direction) * 4 * pi / (2 * rows * rows);
      }
    for (int n = 0; n < draws; ++n) {
      SampleSequence numbers(SampleSequence::mixed(n), 0);
      const float choice = numbers.number();
      const Vec3f direction = cones.sample(choice, numbers.pair());
      EXPECT_NEAR(length(direction), 1, 1e-5);
      ASSERT_GT(cones.density(direction), 0);
      if (isUpper(direction)) ++drawnUpper;
    }
    EXPECT_NEAR(drawnUpper / draws, upper, 0.01 + 4.5 * 0.5 / std::sqrt(draws));
  }
}

TEST(FireCones, NothingBelowTheHorizonIsDrawn) {
  const GasMedium gas = twoFires();
  const FireDirections fire(gas);
  EXPECT_TRUE(FireCones(fire, {3, 0, 0}, {1, 0, 0}).isDark());
  EXPECT_FALSE(FireCones(fire, {3, 0, 0}, {-1, 0, 0}).isDark());
}
