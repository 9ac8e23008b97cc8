#include <gtest/gtest.h>

#include "base/random.h"
#include "render/noise.h"
#include "render/textures.h"

using namespace brisance;

namespace {

Vec3d someWhere(int i) {
  const Random random(9, Stream::test);
  return Vec3d(random.uniform(3 * i), random.uniform(3 * i + 1), random.uniform(3 * i + 2)) * 60 - Vec3d(30, 30, 30);
}

}  // namespace

TEST(GradientNoise, IsZeroOnTheLatticeAndOfMeanZeroBetween) {
  double sum = 0, squares = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Vec3d p = someWhere(i);
    EXPECT_EQ(gradientNoise({std::floor(p.x), std::floor(p.y), std::floor(p.z)}), 0);
    const double n = gradientNoise(p);
    EXPECT_LE(std::abs(n), 1.05);  // 1.036 is what these gradients reach at most
    sum += n;
    squares += n * n;
  }
  const double deviation = std::sqrt(squares / count);
  EXPECT_GT(deviation, 0.2);
  EXPECT_NEAR(sum / count, 0, 5 * deviation / std::sqrt(count));
}

TEST(GradientNoise, IsSmoothAcrossTheLattice) {
  constexpr double h = 1e-5;
  for (int i = 0; i < 200; ++i) {
    Vec3d p = someWhere(i);
    p.x = std::floor(p.x);
    const auto slope = [&](double x) {
      return (gradientNoise({x + h, p.y, p.z}) - gradientNoise({x - h, p.y, p.z})) / (2 * h);
    };
    EXPECT_NEAR(slope(p.x - 2 * h), slope(p.x + 2 * h), 1e-6);
  }
}

TEST(HarmonicNoise, AddsWeakerAndFinerNoise) {
  const Vec3d p{1.3, -2.7, 0.4};
  EXPECT_EQ(harmonicNoise(p, {2, 3, 1}), gradientNoise(p));
  EXPECT_DOUBLE_EQ(harmonicNoise(p, {2, 3, 2}), gradientNoise(p) + gradientNoise(p * 3) / 2);
}

TEST(Checkerboard, ChangesAtEachFieldAlsoBelowZero) {
  const Checkerboard board{{1, 1, 1}, {0, 0, 0}, 4};
  const auto at = [&](float u, float v) { return patternColour(board, {{u, v}, {}}).x; };
  EXPECT_EQ(at(0.1f, 0.1f), 1);
  EXPECT_EQ(at(0.3f, 0.1f), 0);
  EXPECT_EQ(at(0.3f, 0.3f), 1);
  EXPECT_EQ(at(-0.1f, 0.1f), 0);
  EXPECT_EQ(at(-0.1f, -0.1f), 1);
}

TEST(WoodAndMarble, MixTheirColoursAndScaleWithTheirUnit) {
  const Wood wood{{0, 0, 0}, {1, 1, 1}, 1}, coarse{{0, 0, 0}, {1, 1, 1}, 2};
  const Marble marble{{0, 0, 0}, {1, 1, 1}, 1};
  double least = 1, most = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3f p(someWhere(i));
    for (const float share : {patternColour(wood, {{}, p}).x, patternColour(marble, {{}, p}).x}) {
      EXPECT_GE(share, 0);
      EXPECT_LE(share, 1);
      least = std::min<double>(least, share);
      most = std::max<double>(most, share);
    }
    EXPECT_EQ(patternColour(wood, {{}, p}), patternColour(coarse, {{}, p * 2.0f}));
  }
  EXPECT_LT(least, 0.05);
  EXPECT_GT(most, 0.95);
}
