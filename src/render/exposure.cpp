#include "render/exposure.h"

#include <algorithm>

#include "base/parallel.h"
#include "render/sample_allotment.h"

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
  struct Sample {
    int pixel, number;
  };
  std::vector<std::array<int, 2>> pixels;
  std::vector<Sample> samples;
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

/// Calls visit(block) for all pixels of a picture, block by block, on all threads.
template <class Visit>
void forBlocks(int width, int height, const Visit& visit) {
  const int columns = (width + tileSize - 1) / tileSize, rows = (height + tileSize - 1) / tileSize;
  parallelFor(0, static_cast<std::int64_t>(columns) * rows, 1, [&](std::int64_t first, std::int64_t last) {
    PixelBlock block;
    for (std::int64_t tile = first; tile < last; ++tile) {
      const int left = static_cast<int>(tile % columns) * tileSize, top = static_cast<int>(tile / columns) * tileSize;
      const int right = std::min(left + tileSize, width), bottom = std::min(top + tileSize, height);
      for (int y = top; y < bottom; y += blockSize)
        for (int x = left; x < right; x += blockSize) {
          block.cover(x, y, std::min(x + blockSize, right), std::min(y + blockSize, bottom));
          visit(block);
        }
    }
  });
}

class Exposure {
 public:
  Exposure(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise)
      : rays_(rays), follow_(follow), noise_(noise), exposed_{Image(width, height), {}, {}} {
    if (noise == Noise::measured) exposed_.variance = Image(width, height);
  }
  int width() const { return exposed_.mean.width; }
  int height() const { return exposed_.mean.height; }

  /// One sample of each pixel after the other.
  Exposed even() {
    if (noise_ == Noise::measured) exposed_.halves[0] = exposed_.halves[1] = exposed_.variance;
    forBlocks(width(), height(), [&](PixelBlock& block) {
      block.samples.clear();
      for (int s = 0; s < rays_.perPixel(); ++s)
        for (int n = 0; n < std::ssize(block.pixels); ++n) block.samples.push_back({n, s});
      draw(
          block, [&](int x, int y, int s) { return rays_.ray(x, y, s); },
          [&](int, int s) {
            return Weight{rays_.weight(s), rays_.field(s)};
          });
      for (std::size_t n = 0; n < block.pixels.size(); ++n) keep(block.pixels[n], block.sums[n], rays_.perPixel());
    });
    return std::move(exposed_);
  }

  /// `drawn` samples for each pixel, then more where they differ more, so that they are `mean` in the mean.
  Exposed byNoise(int drawn, double mean) {
    if (noise_ == Noise::ignored) exposed_.variance = Image(width(), height());
    forBlocks(width(), height(), [&](PixelBlock& block) {
      drawFree(block, [&](int, int) { return Samples{0, drawn}; });
      for (std::size_t n = 0; n < block.pixels.size(); ++n) keep(block.pixels[n], block.sums[n], drawn);
    });
    if (drawn == 1 && noise_ == Noise::measured) exposed_.variance = varianceAround(exposed_.mean);
    const std::vector<int> more = allotSamples(exposed_.mean, exposed_.variance, drawn, mean, rays_.allotment());
    const auto moreOf = [&](int x, int y) { return more[static_cast<std::size_t>(y) * width() + x]; };
    forBlocks(width(), height(), [&](PixelBlock& block) {
      drawFree(block, [&](int x, int y) { return Samples{drawn, moreOf(x, y)}; });
      for (std::size_t n = 0; n < block.pixels.size(); ++n)
        join(block.pixels[n], drawn, block.sums[n], moreOf(block.pixels[n][0], block.pixels[n][1]));
    });
    if (noise_ == Noise::ignored) exposed_.variance = {};
    return std::move(exposed_);
  }

 private:
  struct Weight {
    float share;
    int half;
  };
  struct Samples {
    int first, count;
  };

  /// Samples that count alike: those of each pixel are one another's neighbours in a packet.
  template <class SamplesOf>
  void drawFree(PixelBlock& block, const SamplesOf& samplesOf) const {
    std::array<float, SceneGeometry::packet> shares{};
    block.samples.clear();
    for (int n = 0; n < std::ssize(block.pixels); ++n) {
      const Samples samples = samplesOf(block.pixels[n][0], block.pixels[n][1]);
      for (int s = 0; s < samples.count; ++s) block.samples.push_back({n, samples.first + s});
      shares[n] = samples.count > 0 ? 1 / static_cast<float>(samples.count) : 0;
    }
    draw(
        block, [&](int x, int y, int s) { return rays_.freeRay(x, y, s); },
        [&](int n, int) {
          return Weight{shares[n], 0};
        });
  }

  /// Sums up the block's samples, a packet at a time.
  template <class RayOf, class WeightOf>
  void draw(PixelBlock& block, const RayOf& rayOf, const WeightOf& weightOf) const {
    block.sums.fill({});
    const std::span<const PixelBlock::Sample> all(block.samples);
    for (std::size_t first = 0; first < all.size(); first += SceneGeometry::packet) {
      const auto some = all.subspan(first, std::min<std::size_t>(SceneGeometry::packet, all.size() - first));
      block.rays.clear();
      for (const auto& [n, s] : some) block.rays.push_back(rayOf(block.pixels[n][0], block.pixels[n][1], s));
      follow_(block.rays, std::span(block.light).first(some.size()));
      for (std::size_t i = 0; i < some.size(); ++i) {
        const Weight weight = weightOf(some[i].pixel, some[i].number);
        block.sums[some[i].pixel].add(block.light[i], weight.share, weight.half);
      }
    }
  }
  void keep(const std::array<int, 2>& pixel, const PixelSums& sums, int samples) {
    const auto [x, y] = pixel;
    exposed_.mean(x, y) = sums.mean();
    if (exposed_.variance.width > 0) exposed_.variance(x, y) = sums.variance(samples);
    for (int half = 0; half < 2; ++half)
      if (exposed_.halves[half].width > 0) exposed_.halves[half](x, y) = sums.half(half);
  }
  /// Joins `more` samples to the `drawn` ones that were kept (Chan, Golub & LeVeque 1979).
  void join(const std::array<int, 2>& pixel, int drawn, const PixelSums& sums, int more) {
    if (more == 0) return;
    const auto [x, y] = pixel;
    const auto a = static_cast<float>(drawn), b = static_cast<float>(more), all = a + b;
    const Vec3f off = sums.mean() - exposed_.mean(x, y);
    const Vec3f spread =
        exposed_.variance(x, y) * (a * (a - 1)) + sums.variance(more) * (b * (b - 1)) + off * off * (a * b / all);
    exposed_.variance(x, y) = spread / (all * (all - 1));
    exposed_.mean(x, y) += off * (b / all);
  }

  const CameraRays& rays_;
  const Follow& follow_;
  Noise noise_;
  Exposed exposed_;
};

}  // namespace

Exposed expose(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise) {
  return Exposure(rays, width, height, follow, noise).even();
}

Exposed exposeByNoise(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise,
                      double samples) {
  // A pixel's two samples tell its noise better than two pixels' samples; of few that leaves too few to share out.
  constexpr double enoughForTwo = 2.5;
  const int drawn = samples < enoughForTwo ? 1 : std::max(static_cast<int>(samples / 4), 2);
  return Exposure(rays, width, height, follow, noise).byNoise(drawn, samples);
}

}  // namespace brisance
