// Two bytes a cell say what the picture would have drawn.
#include "view/compact_gas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.h"

namespace brisance {
namespace {

const Random& random_() {
  static const Random random(5, Stream::test);
  return random;
}

/// A ball of soot of one temperature, with deviation 0.1 m, each particle of a gram.
FrameParticles ball(int count, float temperature) {
  FrameParticles particles;
  for (int p = 0; p < count; ++p) {
    const auto at = [&](int axis) {
      return static_cast<float>(1 + 0.1 * random_().normal(static_cast<std::uint64_t>(3 * p + axis)));
    };
    particles.position.emplace_back(at(0), at(1), at(2));
    particles.velocity.emplace_back();
    particles.mass.push_back(1e-3f);
    particles.temperature.push_back(temperature);
    particles.kind.push_back(2);
  }
  return particles;
}

VolumeSettings settings() {
  VolumeSettings volume;
  volume.cells = {400, 400, 400};
  volume.cellSize = 0.005;
  volume.blur = 0.02;
  volume.fullDensity = 500;
  return volume;
}

const BlackbodyColours& heat() {
  static const BlackbodyColours colours{PhysicalBlackbody{}};
  return colours;
}

TEST(CompactGas, HoldsTheMassThatIsThereOnALatticeOfBoundedSize) {
  Frame frame;
  frame.particles = ball(4000, 1600);
  const auto gas = compactGas(frame, settings(), heat(), HeatScale(heat()));
  ASSERT_TRUE(gas);
  EXPECT_LE(std::max({gas->size.x, gas->size.y, gas->size.z}), mostCells);
  double mass = 0;
  for (const std::uint8_t level : gas->density)
    mass += std::pow(level / double(densityLevels - 1), 2) * settings().fullDensity * std::pow(gas->cellSize, 3);
  EXPECT_NEAR(mass, 4.0, 0.04 * 4);  // levels are 1/63 of the root apart; thin cells round to nothing
}

TEST(CompactGas, IsFinerWhereTheGasFillsLess) {
  Frame frame;
  frame.particles = ball(4000, 1600);
  Frame wide = frame;
  wide.particles.position[0] = {0.05f, 0.05f, 1.9f};
  const HeatScale scale(heat());
  VolumeSettings sharp = settings();
  sharp.blur = 0.005;
  EXPECT_LT(compactGas(frame, sharp, heat(), scale)->cellSize, 0.8 * compactGas(wide, sharp, heat(), scale)->cellSize);
}

TEST(CompactGas, HeatIsThatOfTheParticles) {
  Frame frame;
  frame.particles = ball(4000, 1600);
  const auto gas = compactGas(frame, settings(), heat(), HeatScale(heat()));
  ASSERT_TRUE(gas);
  const double step = (HeatScale::hottest - HeatScale::coldest) / (heatLevels - 1);
  for (std::size_t cell = 0; cell < gas->heat.size(); ++cell)
    if (gas->density[cell] > densityLevels / 4) {
      ASSERT_NEAR(HeatScale::coldest + gas->heat[cell] * step, 1600, step);
    }
}

TEST(CompactGas, ThereIsNoneWhereThePictureDrawsNone) {
  Frame frame;
  const HeatScale scale(heat());
  EXPECT_FALSE(compactGas(frame, settings(), heat(), scale));
  frame.particles = ball(10, 300);
  VolumeSettings hidden = settings();
  hidden.drawn = false;
  EXPECT_FALSE(compactGas(frame, hidden, heat(), scale));
}

/// What the page does: src/moment.js, foretoldAgain.
std::vector<std::uint8_t> restored(std::vector<std::uint8_t> values, const Vec3i& size) {
  const auto at = [&](int i, int j, int k) -> std::uint8_t& { return values[i + size.x * (j + size.y * k)]; };
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        int guess = k > 0 ? at(0, 0, k - 1) : 0;
        if (i > 0 && j > 0) {
          const int left = at(i - 1, j, k), below = at(i, j - 1, k), corner = at(i - 1, j - 1, k);
          guess = std::clamp(left + below - corner, std::min(left, below), std::max(left, below));
        } else if (i > 0) {
          guess = at(i - 1, j, k);
        } else if (j > 0) {
          guess = at(i, j - 1, k);
        }
        at(i, j, k) = static_cast<std::uint8_t>(at(i, j, k) + guess);
      }
  return values;
}

TEST(Residuals, GiveTheValuesBackWhereTheyCount) {
  const Vec3i size{7, 5, 4};
  std::vector<std::uint8_t> values(7 * 5 * 4), mask(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = static_cast<std::uint8_t>(256 * random_().uniform(n));
    mask[n] = n % 3 == 0;
  }
  EXPECT_EQ(restored(residuals(values, size), size), values);
  const auto masked = restored(residuals(values, mask, size), size);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (mask[n]) {
      EXPECT_EQ(masked[n], values[n]) << n;
    }
}

TEST(HeatScale, ByteOfLightIsThatOfItsTemperature) {
  const HeatScale scale(heat());
  for (double kelvin = 900; kelvin < 2900; kelvin += 100)
    EXPECT_NEAR(scale.ofLight(heat()(static_cast<float>(kelvin))), scale.ofTemperature(kelvin), 1) << kelvin;
  EXPECT_EQ(scale.ofLight({}), 0);
  EXPECT_EQ(scale.ofTemperature(10000), 255);
}

}  // namespace
}  // namespace brisance
