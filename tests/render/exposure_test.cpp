// Samples shared out by noise.
#include "render/exposure.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "base/parallel.h"

using namespace brisance;

namespace {

constexpr int side = 96;

CameraRays raysOf(double samples) {
  RenderSettings settings;
  settings.width = settings.height = side;
  settings.samples = samples;
  return {settings, {}, 1};
}

Exposed drawnByNoise(const Follow& follow, Noise noise, double samples = 16) {
  return exposeByNoise(raysOf(std::sqrt(samples)), side, side, follow, noise, samples);
}

/// Light of mean 1: on the left even in 0.9 .. 1.1; on the right 20 in one of 20 samples, else 0.
class HalfNoisy {
 public:
  Follow follow() {
    return [this](std::span<CameraRay> packet, std::span<Vec3f> light) {
      drawn_ += static_cast<std::int64_t>(packet.size());
      for (std::size_t n = 0; n < packet.size(); ++n) {
        const float x = NumberRun(packet[n].numbers.bits())();
        const float value = packet[n].ray.direction.x < 0 ? 0.9f + 0.2f * x : x < 0.05f ? 20.f : 0.f;
        light[n] = {value, value, value};
      }
    };
  }
  std::int64_t drawn() const { return drawn_; }

 private:
  std::atomic<std::int64_t> drawn_ = 0;
};

struct Measured {
  double mean = 0, squares = 0, variance = 0;  ///< squares: of the distances from 1
};

/// Over the pixels of one half of the picture, of which those at the seam are left out.
Measured measure(const Exposed& exposed, bool right) {
  constexpr int seam = 4;
  Measured sum;
  int count = 0;
  for (int y = 0; y < side; ++y)
    for (int x = right ? side / 2 + seam : 0; x < (right ? side : side / 2 - seam); ++x, ++count) {
      const double off = exposed.mean(x, y).x - 1;
      sum.mean += exposed.mean(x, y).x;
      sum.squares += off * off;
      sum.variance += exposed.variance(x, y).x;
    }
  return {sum.mean / count, sum.squares / count, sum.variance / count};
}

}  // namespace

TEST(ExposureByNoise, TakesAsManySamplesAsEvenly) {
  for (const double samples : {1.3, 2.0, 2.5, 9.0, 16.0, 49.0}) {
    HalfNoisy light;
    drawnByNoise(light.follow(), Noise::ignored, samples);
    EXPECT_NEAR(static_cast<double>(light.drawn()) / (side * side), samples, 0.02 * samples);
  }
}

// The light of the right half is of the kind that tempts: most pixels look dark and even after a few samples.
TEST(ExposureByNoise, IsUnbiasedAndKnowsItsVariance) {
  for (const double samples : {2.0, 3.0, 16.0}) {
    HalfNoisy light;
    const Exposed exposed = drawnByNoise(light.follow(), Noise::measured, samples);
    for (const bool right : {false, true}) {
      const Measured half = measure(exposed, right);
      const double count = side * (side / 2 - 4);
      EXPECT_NEAR(half.mean, 1, 4.5 * std::sqrt(half.squares / count)) << samples << right;
      if (samples < 3) continue;  // of singles it is only guessed
      EXPECT_NEAR(half.variance, half.squares, 0.2 * half.squares) << samples << right;
    }
  }
}

TEST(ExposureByNoise, MakesLessNoiseOfAsManySamples) {
  HalfNoisy light;
  const Exposed even = expose(raysOf(4), side, side, light.follow(), Noise::measured);
  const Exposed shared = drawnByNoise(light.follow(), Noise::measured);
  // The left half gives up three quarters of its samples, which nearly doubles those of the right; they would halve its
  // variance if each pixel's neighbours knew how it varies.
  EXPECT_LT(measure(shared, true).squares, 0.75 * measure(even, true).squares);
}

// As many samples as pixels: each has a single one.
TEST(ExposureByNoise, KnowsTheVarianceOfSinglesFromThoseAround) {
  const Follow follow = [](std::span<CameraRay> packet, std::span<Vec3f> light) {
    for (std::size_t n = 0; n < packet.size(); ++n) light[n] = {NumberRun(packet[n].numbers.bits())(), 0, 0};
  };
  const Exposed exposed = drawnByNoise(follow, Noise::measured, 1);
  double sum = 0;
  for (const Vec3f& variance : exposed.variance.pixels) sum += variance.x;
  EXPECT_NEAR(sum / (side * side), 1.0 / 12, 0.04 / 12);  // 1 % is a deviation
}

TEST(ExposureByNoise, IsTheSameForAnyNumberOfThreadsAndWhetherNoiseIsAskedForOrNot) {
  HalfNoisy light;
  const auto picture = [&](int threads, Noise noise) {
    const ThreadLimit limit(threads);
    return drawnByNoise(light.follow(), noise).mean;
  };
  EXPECT_EQ(picture(1, Noise::measured), picture(4, Noise::ignored));
}
