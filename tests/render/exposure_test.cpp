// Samples shared out by noise.
#include "render/exposure.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "base/parallel.h"

using namespace brisance;

namespace {

constexpr int side = 96;

CameraRays raysOf(int samples) {
  RenderSettings settings;
  settings.width = settings.height = side;
  settings.samples = samples;
  return {settings, {}, 1};
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
  double mean = 0, squares = 0, variance = 0, halves = 0;  ///< squares: of the distances from 1
};

/// Over the pixels of one half of the picture, of which those at the seam are left out.
Measured measure(const Exposed& exposed, bool right) {
  constexpr int seam = 4;
  Measured sum;
  int count = 0;
  for (int y = 0; y < side; ++y)
    for (int x = right ? side / 2 + seam : 0; x < (right ? side : side / 2 - seam); ++x, ++count) {
      const double off = exposed.mean(x, y).x - 1, apart = exposed.halves[0](x, y).x - exposed.halves[1](x, y).x;
      sum.mean += exposed.mean(x, y).x;
      sum.squares += off * off;
      sum.variance += exposed.variance(x, y).x;
      sum.halves += apart * apart / 4;
    }
  return {sum.mean / count, sum.squares / count, sum.variance / count, sum.halves / count};
}

}  // namespace

TEST(ExposureByNoise, TakesAsManySamplesAsEvenly) {
  for (const int samples : {3, 4, 7}) {
    HalfNoisy light;
    expose(raysOf(samples), side, side, light.follow(), Noise::ignored, Sampling::byNoise);
    EXPECT_NEAR(static_cast<double>(light.drawn()) / (side * side), samples * samples, 0.02 * samples * samples);
  }
}

// The light of the right half is of the kind that tempts: most pixels look dark and even after a few samples.
TEST(ExposureByNoise, IsUnbiasedAndKnowsItsVariance) {
  HalfNoisy light;
  const Exposed exposed = expose(raysOf(4), side, side, light.follow(), Noise::measured, Sampling::byNoise);
  for (const bool right : {false, true}) {
    const Measured half = measure(exposed, right);
    const double count = side * (side / 2 - 4);
    EXPECT_NEAR(half.mean, 1, 4.5 * std::sqrt(half.squares / count)) << right;
    EXPECT_NEAR(half.variance, half.squares, 0.2 * half.squares) << right;
    EXPECT_NEAR(half.halves, half.squares, 0.2 * half.squares) << right;
  }
}

TEST(ExposureByNoise, MakesLessNoiseOfAsManySamples) {
  HalfNoisy light;
  const Exposed even = expose(raysOf(4), side, side, light.follow(), Noise::measured);
  const Exposed shared = expose(raysOf(4), side, side, light.follow(), Noise::measured, Sampling::byNoise);
  // The left half gives up three quarters of its samples, which nearly doubles those of the right; they would halve its
  // variance if each pixel's neighbours knew how it varies.
  EXPECT_LT(measure(shared, true).squares, 0.75 * measure(even, true).squares);
}

TEST(ExposureByNoise, IsTheSameForAnyNumberOfThreadsAndWhetherNoiseIsAskedForOrNot) {
  HalfNoisy light;
  const auto picture = [&](int threads, Noise noise) {
    const ThreadLimit limit(threads);
    return expose(raysOf(4), side, side, light.follow(), noise, Sampling::byNoise).mean;
  };
  EXPECT_EQ(picture(1, Noise::measured), picture(4, Noise::ignored));
}
