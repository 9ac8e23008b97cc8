#include "render/exposure.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int tileSize = 16;  // [pixels]: small enough that two threads end together
constexpr int blockSize = 4;  // [pixels]: their rays go together
static_assert(blockSize * blockSize == SceneGeometry::packet);

/// Some pixels, and a packet of rays of theirs.
struct PixelBlock {
  std::vector<std::array<int, 2>> pixels;
  std::vector<CameraRay> rays;
  std::array<Vec3f, SceneGeometry::packet> light;

  PixelBlock() {
    pixels.reserve(SceneGeometry::packet);
    rays.reserve(SceneGeometry::packet);
  }
  void cover(int left, int top, int right, int bottom) {
    pixels.clear();
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) pixels.push_back({x, y});
  }
};

/// One sample of each pixel after the other.
void draw(PixelBlock& block, const CameraRays& rays, const Follow& follow, Image& image) {
  for (int s = 0; s < rays.perPixel(); ++s) {
    block.rays.clear();
    for (const auto& [x, y] : block.pixels) block.rays.push_back(rays.ray(x, y, s));
    follow(block.rays, std::span(block.light).first(block.rays.size()));
    for (std::size_t n = 0; n < block.pixels.size(); ++n)
      image(block.pixels[n][0], block.pixels[n][1]) += block.light[n] * rays.weight(s);
  }
}

}  // namespace

Image expose(const CameraRays& rays, int width, int height, const Follow& follow) {
  Image image(width, height);
  const int columns = (width + tileSize - 1) / tileSize, rows = (height + tileSize - 1) / tileSize;
  parallelFor(0, static_cast<std::int64_t>(columns) * rows, 1, [&](std::int64_t first, std::int64_t last) {
    PixelBlock block;
    for (std::int64_t tile = first; tile < last; ++tile) {
      const int left = static_cast<int>(tile % columns) * tileSize, top = static_cast<int>(tile / columns) * tileSize;
      const int right = std::min(left + tileSize, width), bottom = std::min(top + tileSize, height);
      for (int y = top; y < bottom; y += blockSize)
        for (int x = left; x < right; x += blockSize) {
          block.cover(x, y, std::min(x + blockSize, right), std::min(y + blockSize, bottom));
          draw(block, rays, follow, image);
        }
    }
  });
  return image;
}

}  // namespace brisance
