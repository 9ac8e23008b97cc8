#include "render/denoise.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

constexpr int width = 64, height = 48;

/// A picture whose light is `truth` with chance of a relative `deviation` in each half of its samples.
struct Made {
  Image truth{width, height};
  Exposed picture;
  PictureGuides guides;

  template <class Light, class Albedo>
  Made(const Light& light, const Albedo& albedo, double deviation, std::uint64_t seed = 1) {
    const Image black(width, height);
    const std::vector<float> zeros(width * height);
    picture = {black, black, {black, black}};
    guides = {black, black, black, zeros, zeros, {black, black}, {black, black}};
    const Random random(seed, Stream::test);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t p = static_cast<std::size_t>(y) * width + x;
        truth.pixels[p] = light(x, y);
        guides.albedo.pixels[p] = guides.albedoOfHalf[0].pixels[p] = guides.albedoOfHalf[1].pixels[p] = albedo(x, y);
        for (int half = 0; half < 2; ++half)
          picture.halves[half].pixels[p] =
              light(x, y) * static_cast<float>(1 + deviation * random.normal(2 * p + half));
        picture.mean.pixels[p] = (picture.halves[0].pixels[p] + picture.halves[1].pixels[p]) * 0.5f;
      }
  }
  Image cleaned() const { return denoised(picture, guides); }
};

double error(const Image& image, const Image& truth) {
  double sum = 0;
  for (std::size_t p = 0; p < image.pixels.size(); ++p) {
    const Vec3f off = image.pixels[p] - truth.pixels[p];
    sum += dot(off, off) / 3;
  }
  return std::sqrt(sum / static_cast<double>(image.pixels.size()));
}

double meanOf(const Image& image) {
  double sum = 0;
  for (const Vec3f& pixel : image.pixels) sum += pixel.x;
  return sum / static_cast<double>(image.pixels.size());
}

Vec3f grey(float value) { return {value, value, value}; }
const auto half = [](int, int) { return grey(0.5f); };

}  // namespace

TEST(Denoise, EvenLightLosesItsNoiseAndKeepsItsMean) {
  const Made made(half, half, 0.5);
  const Image cleaned = made.cleaned();
  EXPECT_LT(error(cleaned, made.truth), error(made.picture.mean, made.truth) / 8);
  EXPECT_NEAR(meanOf(cleaned), 0.5, 4 * 0.25 / std::sqrt(2.0 * width * height));
}

TEST(Denoise, LightThatNoChanceDecidesStaysAsItIs) {
  Made made(
      half, [](int, int) { return Vec3f{}; }, 0);
  made.guides.certain = made.guides.certainOfHalf[0] = made.guides.certainOfHalf[1] = made.truth;
  EXPECT_LT(error(made.cleaned(), made.truth), 1e-6);
}

TEST(Denoise, TexturesStaySharp) {
  const auto board = [](int x, int y) { return (x / 3 + y / 3) % 2 ? Vec3f(0.8f, 0.6f, 0.2f) : grey(0.05f); };
  const Made made([&](int x, int y) { return board(x, y) * 0.7f; }, board, 0.3);
  EXPECT_LT(error(made.cleaned(), made.truth), error(made.picture.mean, made.truth) / 5);
}

// A surface that turns away at a sharp edge, its light told apart by its normal alone.
TEST(Denoise, EdgesThatTheGuidesKnowStaySharp) {
  const auto bright = [](int x, int y) { return x + y / 2 < 40; };
  Made made([&](int x, int y) { return grey(bright(x, y) ? 1.0f : 0.2f); }, half, 0.4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) made.guides.normal(x, y) = bright(x, y) ? Vec3f(0, 0, 1) : Vec3f(0.6f, 0.8f, 0);
  EXPECT_LT(error(made.cleaned(), made.truth), error(made.picture.mean, made.truth) / 5);
}

TEST(Denoise, AGradientWithoutGuidesIsNoStaircase) {
  const Made made(
      [](int x, int y) { return grey(0.2f + 0.01f * static_cast<float>(x) + 0.005f * static_cast<float>(y)); }, half,
      0.2);
  EXPECT_LT(error(made.cleaned(), made.truth), error(made.picture.mean, made.truth) / 5);
}

TEST(Denoise, ALuckyPathLeavesNoBlotch) {
  Made made(half, half, 0.2);
  made.picture.halves[0](30, 20) = grey(500);
  const Image cleaned = made.cleaned();
  float brightest = 0;
  for (const Vec3f& pixel : cleaned.pixels) brightest = std::max(brightest, pixel.x);
  EXPECT_LT(brightest, 0.75f);
}

TEST(Denoise, IsTheSameForOneThreadAndFour) {
  const Made made(half, half, 0.5);
  const auto cleaned = [&](int threads) {
    const ThreadLimit limit(threads);
    return made.cleaned();
  };
  EXPECT_EQ(cleaned(1), cleaned(4));
}
