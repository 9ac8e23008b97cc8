#include "render/image.h"

#include <gtest/gtest.h>

#include <numeric>

#include "render/sampling.h"

using namespace brisance;

TEST(ToneCurve, ShadowsAreShownAsTheyAre) {
  const Vec3f grey{0.18f, 0.18f, 0.18f};
  const Vec3f shown = toneMapped(grey, 0);
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(shown[channel], 0.18f, 1e-6);
  EXPECT_EQ(toneMapped({}, 0), Vec3f{});
}

TEST(ToneCurve, RisesWithoutEndingBelowWhiteAndNeverBeyondIt) {
  float before = -1;
  for (float light = 0; light < 30; light += 0.01f) {
    const float shown = toneMapped({light, light, light}, 0).x;
    EXPECT_GE(shown, before);
    EXPECT_LE(shown, 1);
    before = shown;
  }
  EXPECT_EQ(toneMapped({1e6f, 1e6f, 1e6f}, 0), Vec3f(1, 1, 1));
}

TEST(ToneCurve, AStopIsADoubling) {
  const Vec3f light{0.4f, 0.2f, 0.1f};
  EXPECT_EQ(toneMapped(light, 1), toneMapped(light * 2, 0));
  EXPECT_EQ(toneMapped(light, -2), toneMapped(light * 0.25f, 0));
}

// The colours are those of black bodies at 1600, 2000 and 2700 K, the first exposed to 0.1, the others to 1 and 15.
TEST(ToneCurve, FireGoesFromRedThroughOrangeToNearlyWhite) {
  const Vec3f rim = toneMapped({0.33f, 0.042f, 0}, 0), body = toneMapped({2.5f, 0.65f, 0.02f}, 0),
              core = toneMapped({26, 12.5f, 2.9f}, 0);
  EXPECT_LT(rim.y, 0.25f * rim.x);
  EXPECT_GT(body.y, 0.3f * body.x);
  EXPECT_LT(body.y, 0.8f * body.x);
  EXPECT_GT(core.y, 0.9f * core.x);
  EXPECT_GT(core.z, 0.6f * core.x);
}

TEST(Srgb, DecodingUndoesEncoding) {
  for (int code = 0; code < 256; ++code) {
    const float value = static_cast<float>(code) / 255;
    EXPECT_NEAR(srgbEncoded(srgbDecoded(value)), value, 2e-5);  // the standard's two branches meet to 1e-5
  }
  EXPECT_NEAR(srgbDecoded(0.5f), 0.21404f, 1e-5);  // IEC 61966-2-1
}

TEST(Sampling, WeightsAreOneAtTheEdgeAndOneAndAHalfInsideOverTheirSum) {
  EXPECT_EQ(subPixelWeights(1), std::vector<float>{1});
  EXPECT_EQ(subPixelWeights(2), std::vector<float>(4, 0.25f));
  const std::vector<float> four = subPixelWeights(4);  // 12 at the edge, 4 inside: sum 18
  EXPECT_FLOAT_EQ(four[0], 1 / 18.f);
  EXPECT_FLOAT_EQ(four[5], 1.5f / 18);
  for (int n = 1; n < 9; ++n) {
    const std::vector<float> weights = subPixelWeights(n);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-6);
  }
}

TEST(ContentHash, TellsPicturesApartByShapeAndPixel) {
  Image image(4, 2);
  const std::string black = contentHash(image);
  EXPECT_NE(contentHash(Image(2, 4)), black);
  image(3, 1).y = 1e-30f;
  EXPECT_NE(contentHash(image), black);
}
