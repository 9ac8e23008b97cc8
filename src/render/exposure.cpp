#include "render/exposure.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int tileSize = 16;  // [pixels]: small enough that two threads end together

constexpr int blockSize = 4;  // [pixels]: their rays go together
static_assert(blockSize * blockSize == SceneGeometry::packet);

/// The samples of one pixel, summed up.
class PixelSums {
 public:
  void add(const Vec3f& light, float weight, int half) {
    const Vec3d weighted = Vec3d(light) * static_cast<double>(weight);
    mean_ += light * weight;
    weights2_ += static_cast<double>(weight) * weight;
    once_ += weighted * static_cast<double>(weight);
    twice_ += weighted * weighted;
    ofHalf_[half] += light * weight;
    weightOfHalf_[half] += weight;
  }
  const Vec3f& mean() const { return mean_; }
  /// Sum of the squared weights times the squared distances from the mean, n / (n - 1) times since the mean is theirs.
  Vec3f variance(int count) const {
    if (count < 2) return {};
    const Vec3d mean(mean_);
    const Vec3d spread = twice_ - mean * once_ * 2.0 + mean * mean * weights2_;
    return max(Vec3f(spread * (count / (count - 1.0))), Vec3f{});
  }
  Vec3f half(int which) const { return weightOfHalf_[which] > 0 ? ofHalf_[which] / weightOfHalf_[which] : mean_; }

 private:
  Vec3f mean_;
  Vec3d once_, twice_;
  double weights2_ = 0;
  std::array<Vec3f, 2> ofHalf_;
  std::array<float, 2> weightOfHalf_{};
};

/// Some pixels, and a packet of rays of theirs.
struct PixelBlock {
  std::vector<std::array<int, 2>> pixels;
  std::vector<CameraRay> rays;
  std::array<Vec3f, SceneGeometry::packet> light;
  std::array<PixelSums, SceneGeometry::packet> sums;

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

void keep(const PixelBlock& block, int samples, Noise noise, Exposed& exposed) {
  for (std::size_t n = 0; n < block.pixels.size(); ++n) {
    const auto [x, y] = block.pixels[n];
    const PixelSums& sums = block.sums[n];
    exposed.mean(x, y) = sums.mean();
    if (noise == Noise::ignored) continue;
    exposed.variance(x, y) = sums.variance(samples);
    for (int half = 0; half < 2; ++half) exposed.halves[half](x, y) = sums.half(half);
  }
}

/// One sample of each pixel after the other.
void draw(PixelBlock& block, const CameraRays& rays, const Follow& follow, Noise noise, Exposed& exposed) {
  block.sums.fill({});
  for (int s = 0; s < rays.perPixel(); ++s) {
    block.rays.clear();
    for (const auto& [x, y] : block.pixels) block.rays.push_back(rays.ray(x, y, s));
    follow(block.rays, std::span(block.light).first(block.rays.size()));
    for (std::size_t n = 0; n < block.pixels.size(); ++n)
      block.sums[n].add(block.light[n], rays.weight(s), rays.field(s));
  }
  keep(block, rays.perPixel(), noise, exposed);
}

}  // namespace

Exposed expose(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise) {
  Exposed exposed{Image(width, height), {}, {}};
  if (noise == Noise::measured) exposed.variance = exposed.halves[0] = exposed.halves[1] = Image(width, height);
  const int columns = (width + tileSize - 1) / tileSize, rows = (height + tileSize - 1) / tileSize;
  parallelFor(0, static_cast<std::int64_t>(columns) * rows, 1, [&](std::int64_t first, std::int64_t last) {
    PixelBlock block;
    for (std::int64_t tile = first; tile < last; ++tile) {
      const int left = static_cast<int>(tile % columns) * tileSize, top = static_cast<int>(tile / columns) * tileSize;
      const int right = std::min(left + tileSize, width), bottom = std::min(top + tileSize, height);
      for (int y = top; y < bottom; y += blockSize)
        for (int x = left; x < right; x += blockSize) {
          block.cover(x, y, std::min(x + blockSize, right), std::min(y + blockSize, bottom));
          draw(block, rays, follow, noise, exposed);
        }
    }
  });
  return exposed;
}

}  // namespace brisance
