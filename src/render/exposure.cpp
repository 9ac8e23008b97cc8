#include "render/exposure.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int tileSize = 16;  // [pixels]: small enough that two threads end together

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

class Exposure {
 public:
  Exposure(const CameraRays& rays, const Follow& follow, Noise noise, Exposed& exposed)
      : rays_(rays), follow_(follow), noise_(noise), exposed_(exposed) {}

  void draw(int x, int y) const { noise_ == Noise::ignored ? drawMean(x, y) : drawAll(x, y); }

 private:
  Vec3f light(int x, int y, int s) const {
    CameraRay sample = rays_.ray(x, y, s);
    return follow_(sample.ray, sample.phase, sample.numbers);
  }
  void drawMean(int x, int y) const {
    Vec3f sum;
    for (int s = 0; s < rays_.perPixel(); ++s) sum += light(x, y, s) * rays_.weight(s);
    exposed_.mean(x, y) = sum;
  }
  void drawAll(int x, int y) const {
    PixelSums sums;
    for (int s = 0; s < rays_.perPixel(); ++s) sums.add(light(x, y, s), rays_.weight(s), rays_.field(s));
    exposed_.mean(x, y) = sums.mean();
    exposed_.variance(x, y) = sums.variance(rays_.perPixel());
    for (int half = 0; half < 2; ++half) exposed_.halves[half](x, y) = sums.half(half);
  }

  const CameraRays& rays_;
  const Follow& follow_;
  Noise noise_;
  Exposed& exposed_;
};

}  // namespace

Exposed expose(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise) {
  Exposed exposed{Image(width, height), {}, {}};
  if (noise == Noise::measured) exposed.variance = exposed.halves[0] = exposed.halves[1] = Image(width, height);
  const Exposure exposure(rays, follow, noise, exposed);
  const int columns = (width + tileSize - 1) / tileSize, rows = (height + tileSize - 1) / tileSize;
  parallelFor(0, static_cast<std::int64_t>(columns) * rows, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t tile = first; tile < last; ++tile) {
      const int left = static_cast<int>(tile % columns) * tileSize, top = static_cast<int>(tile / columns) * tileSize;
      for (int y = top; y < std::min(top + tileSize, height); ++y)
        for (int x = left; x < std::min(left + tileSize, width); ++x) exposure.draw(x, y);
    }
  });
  return exposed;
}

}  // namespace brisance
