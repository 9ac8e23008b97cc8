// A picture in memory, and the stated way from scene-linear light to a screen.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Scene-linear light with the primaries of sRGB, row by row from the top left.
struct Image {
  int width = 0, height = 0;
  std::vector<Vec3f> pixels;

  Image() = default;
  Image(int width_, int height_) : width(width_), height(height_), pixels(static_cast<std::size_t>(width_) * height_) {}
  Vec3f& operator()(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Vec3f& operator()(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  friend bool operator==(const Image&, const Image&) = default;
};

/// What a screen shows: sRGB, 8 bits, red green blue, row by row from the top left.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// The tone curve: after `exposureStops` (doublings) each channel is mixed a little with the pixel's luminance, so that
/// very bright colours go to white as film does, and then passes a curve that is linear in the shadows and rolls off
/// to 1. In: scene-linear; out: display-linear in 0 .. 1.
Vec3f toneMapped(const Vec3f& sceneLinear, double exposureStops);
/// Display-linear 0 .. 1 to the sRGB code value 0 .. 1 (IEC 61966-2-1), and back.
float srgbEncoded(float linear);
float srgbDecoded(float code);
/// The picture a screen shows of an image.
Picture developed(const Image& image, double exposureStops);

/// Hash of size and pixels.
std::string contentHash(const Image& image);
std::string contentHash(const Picture& picture);

}  // namespace brisance
