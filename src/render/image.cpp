#include "render/image.h"

#include <array>
#include <cmath>

#include "base/durable_file.h"
#include "base/parallel.h"

namespace brisance {
namespace {

/// Below this a channel is shown as it is: textures keep the look that their authors gave them.
constexpr float shoulderStart = 0.35f;
/// The exposed value that becomes the screen's white; about what fire reaches at 2700 K when 2000 K is exposed to 1.
constexpr float whitePoint = 24;
/// How much of the luminance is mixed into each channel at most, and the peak channel value that has half of it.
constexpr float whiteningShare = 0.30f, whiteningPeak = 9;

constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};  // of the primaries of sRGB (ITU-R BT.709)

/// Linear, then Reinhard's extended curve (Reinhard et al. 2002, eq. 4) joined to it with the same slope.
float filmCurve(float x) {
  if (x <= shoulderStart) return x;
  constexpr float room = 1 - shoulderStart, white = (whitePoint - shoulderStart) / room;
  const float s = (x - shoulderStart) / room;
  return std::min(1.0f, shoulderStart + room * s * (1 + s / (white * white)) / (1 + s));
}

std::uint8_t codeValue(float displayLinear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgbEncoded(displayLinear)));
}

}  // namespace

Vec3f toneMapped(const Vec3f& sceneLinear, double exposureStops) {
  const Vec3f exposed = max(sceneLinear * static_cast<float>(std::exp2(exposureStops)), Vec3f{});
  const float peak = std::max({exposed.x, exposed.y, exposed.z});
  const float share = whiteningShare * peak / (peak + whiteningPeak);
  const float luminance = dot(luminanceWeights, exposed);
  const Vec3f mixed = exposed * (1 - share) + Vec3f(luminance, luminance, luminance) * share;
  return {filmCurve(mixed.x), filmCurve(mixed.y), filmCurve(mixed.z)};
}

float srgbEncoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float srgbDecoded(float code) { return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f); }

Picture developed(const Image& image, double exposureStops) {
  Picture picture{image.width, image.height, std::vector<std::uint8_t>(3 * image.pixels.size())};
  parallelFor(0, static_cast<std::int64_t>(image.pixels.size()), 4096, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t p = first; p < last; ++p) {
      const Vec3f shown = toneMapped(image.pixels[p], exposureStops);
      for (int channel = 0; channel < 3; ++channel) picture.rgb[3 * p + channel] = codeValue(shown[channel]);
    }
  });
  return picture;
}

std::string contentHash(const Image& image) {
  ContentHash hash;
  hash.addValues(std::span<const int>(std::array{image.width, image.height}));
  hash.addValues(std::span<const Vec3f>(image.pixels));
  return hash.hex();
}

std::string contentHash(const Picture& picture) {
  ContentHash hash;
  hash.addValues(std::span<const int>(std::array{picture.width, picture.height}));
  hash.addValues(std::span<const std::uint8_t>(picture.rgb));
  return hash.hex();
}

}  // namespace brisance
