#include "render/sample_allotment.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int mostPerMean = 16;  ///< a pixel has at most so many times the mean
constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};

/// What is seen of a pixel's variance: less the brighter it is.
std::vector<float> seenVariance(const Image& light, const Image& variance) {
  std::vector<float> seen(light.pixels.size());
  for (std::size_t p = 0; p < seen.size(); ++p) {
    const float compressed = 1 + dot(luminanceWeights, light.pixels[p]);
    seen[p] = dot(luminanceWeights, variance.pixels[p]) / (compressed * compressed);
  }
  return seen;
}

/// By distance in pixels across and down; nothing of the pixel itself.
float weightAt(int across, int down) {
  const int distance = std::max(std::abs(across), std::abs(down));
  return distance == 0 ? 0 : distance == 1 ? 1 : 0.25f;
}

/// The deviation of a sample around pixel (x, y).
float deviationAround(const Image& light, const std::vector<float>& seen, int x, int y, int drawn) {
  constexpr int reach = 2;
  float sum = 0, weights = 0;
  for (int down = -reach; down <= reach; ++down)
    for (int across = -reach; across <= reach; ++across) {
      const int i = x + across, j = y + down;
      if (i < 0 || j < 0 || i >= light.width || j >= light.height) continue;
      const float weight = weightAt(across, down);
      sum += weight * seen[static_cast<std::size_t>(j) * light.width + i];
      weights += weight;
    }
  return weights > 0 ? std::sqrt(sum / weights * static_cast<float>(drawn)) : 0;
}

/// By how much deviations are to be multiplied so that samples between `least` and `most` have that mean.
double factorFor(const std::vector<float>& deviations, double mean, double least, double most) {
  const auto meanWith = [&](double factor) {
    double sum = 0;
    for (const float deviation : deviations) sum += std::clamp(factor * deviation, least, most);
    return sum / static_cast<double>(deviations.size());
  };
  double low = 0, high = 1;
  for (int n = 0; n < 60 && meanWith(high) < mean; ++n) high *= 4;
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (low + high);
    (meanWith(middle) < mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<int> allotSamples(const Image& light, const Image& variance, int drawn, int samples, const Random& chance) {
  const std::vector<float> seen = seenVariance(light, variance);
  std::vector<float> deviations(seen.size());
  parallelFor(0, light.height, 8, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < last; ++y)
      for (int x = 0; x < light.width; ++x)
        deviations[static_cast<std::size_t>(y) * light.width + x] = deviationAround(light, seen, x, y, drawn);
  });
  const double most = static_cast<double>(mostPerMean) * samples;
  const double factor = factorFor(deviations, samples, drawn, most);
  std::vector<int> more(seen.size());
  for (std::size_t p = 0; p < more.size(); ++p)
    more[p] = static_cast<int>(std::clamp<double>(factor * deviations[p], drawn, most) - drawn + chance.uniform(p));
  return more;
}

}  // namespace brisance
