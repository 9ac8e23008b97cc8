#include "render/environment.h"

#include <gtest/gtest.h>

#include "base/random.h"

using namespace brisance;

namespace {

/// Dark but for a bright patch and some light everywhere.
Environment sky() {
  Image picture(32, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) picture(x, y) = Vec3f(0.1f, 0.2f, 0.3f) * (x > 20 && x < 24 && y == 5 ? 40.f : 1.f);
  return {picture, EnvironmentSettings{{}, 1, 25}};
}

double overSphere(const auto& f) {
  constexpr int rows = 400, columns = 800;
  double sum = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double y = 2 * (row + 0.5) / rows - 1, angle = 2 * pi * (column + 0.5) / columns, r = std::sqrt(1 - y * y);
      sum += f(Vec3f(Vec3d(r * std::cos(angle), y, r * std::sin(angle))));
    }
  return sum * 4 * pi / (rows * columns);
}

}  // namespace

TEST(Environment, ItsMiddleIsAheadAndItsUpperEdgeAbove) {
  Image picture(4, 2);
  picture(0, 0) = picture(1, 0) = picture(2, 0) = picture(3, 0) = {0, 0, 1};
  picture(2, 1) = {1, 0, 0};  // right of the middle
  const Environment sky(picture, {});
  EXPECT_NEAR(sky({0, 1, 0}).z, 1, 1e-5f);
  const Vec3f right = sky(normalized(Vec3f(1, -2, -1))), left = sky(normalized(Vec3f(-1, -2, -1)));
  EXPECT_GT(right.x, 0.9f);
  EXPECT_LT(left.x, 0.1f);
}

TEST(Environment, ItsDensityIntegratesToOne) {
  const Environment environment = sky();
  EXPECT_NEAR(overSphere([&](const Vec3f& d) { return environment.density(d); }), 1, 0.01);
}

TEST(Environment, SamplesAddUpToItsLight) {
  const Environment environment = sky();
  const double exact = overSphere([&](const Vec3f& d) { return environment(d).y; });
  const Random random(1, Stream::test);
  constexpr int count = 40000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const auto drawn =
        environment.sample(static_cast<float>(random.uniform(2 * i)), static_cast<float>(random.uniform(2 * i + 1)));
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(drawn->density, environment.density(drawn->direction), 1e-4f * drawn->density);
    const double light = drawn->radiance.y / drawn->density;
    sum += light;
    squares += light * light;
  }
  const double mean = sum / count, deviation = std::sqrt((squares / count - mean * mean) / count);
  EXPECT_NEAR(mean, exact, 4 * deviation + 0.01 * exact);
  EXPECT_LT(deviation / mean, 0.01);  // drawn for its light: far below the 2 % of even directions
}

TEST(Environment, OneColourAllAroundIsNothingToDrawFor) {
  const Environment even(Vec3f(1, 2, 3));
  EXPECT_TRUE(even.isEven());
  EXPECT_EQ(even({0, 0, 1}), Vec3f(1, 2, 3));
  EXPECT_FALSE(even.sample(0.5f, 0.5f));
}
