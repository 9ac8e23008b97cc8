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

/// By distance in pixels across and down.
float weightAt(int across, int down) { return std::max(std::abs(across), std::abs(down)) == 1 ? 1 : 0.25f; }

/// Calls visit(neighbour, weight) for the pixels of a picture around (x, y).
template <class Visit>
void visitAround(const Image& picture, int x, int y, const Visit& visit) {
  constexpr int reach = 2;
  for (int down = -reach; down <= reach; ++down)
    for (int across = -reach; across <= reach; ++across) {
      const int i = x + across, j = y + down;
      if ((across == 0 && down == 0) || i < 0 || j < 0 || i >= picture.width || j >= picture.height) continue;
      visit(static_cast<std::size_t>(j) * picture.width + i, weightAt(across, down));
    }
}

/// The deviation of a sample around pixel (x, y), of samples that differ by `seen` from pixel to pixel.
float deviationAround(const Image& light, const std::vector<float>& seen, int x, int y, int drawn) {
  float sum = 0, weights = 0;
  visitAround(light, x, y, [&](std::size_t neighbour, float weight) {
    sum += weight * seen[neighbour];
    weights += weight;
  });
  return weights > 0 ? std::sqrt(sum / weights * static_cast<float>(drawn)) : 0;
}

struct LightAround {
  Vec3f mean, variance;
};
LightAround lightAround(const Image& light, int x, int y) {
  Vec3f sum, squares;
  float weights = 0, weights2 = 0;
  visitAround(light, x, y, [&](std::size_t neighbour, float weight) {
    const Vec3f& value = light.pixels[neighbour];
    sum += weight * value;
    squares += weight * (value * value);
    weights += weight;
    weights2 += weight * weight;
  });
  const float free = weights - weights2 / weights;  // what is left of the weights since the mean is theirs
  if (!(free > 0)) return {};
  const Vec3f mean = sum / weights;
  return {mean, max((squares - weights * (mean * mean)) / free, Vec3f{})};
}

/// The deviation of single samples, from those around pixel (x, y).
float deviationOfSingles(const Image& light, int x, int y) {
  const LightAround around = lightAround(light, x, y);
  return std::sqrt(dot(luminanceWeights, around.variance)) / (1 + dot(luminanceWeights, around.mean));
}

/// Calls visit(x, y, pixel) for all pixels, on all threads.
template <class Visit>
void visitPixels(const Image& picture, const Visit& visit) {
  parallelFor(0, picture.height, 8, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < last; ++y)
      for (int x = 0; x < picture.width; ++x) visit(x, y, static_cast<std::size_t>(y) * picture.width + x);
  });
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

std::vector<int> allotSamples(const Image& light, const Image& variance, int drawn, double samples,
                              const Random& chance) {
  std::vector<float> deviations(light.pixels.size());
  if (drawn == 1) {
    visitPixels(light, [&](int x, int y, std::size_t p) { deviations[p] = deviationOfSingles(light, x, y); });
  } else {
    const std::vector<float> seen = seenVariance(light, variance);
    visitPixels(light, [&](int x, int y, std::size_t p) { deviations[p] = deviationAround(light, seen, x, y, drawn); });
  }
  const double most = mostPerMean * samples;
  const double factor = factorFor(deviations, samples, drawn, most);
  std::vector<int> more(deviations.size());
  for (std::size_t p = 0; p < more.size(); ++p)
    more[p] = static_cast<int>(std::clamp<double>(factor * deviations[p], drawn, most) - drawn + chance.uniform(p));
  return more;
}

Image varianceAround(const Image& light) {
  Image variance(light.width, light.height);
  visitPixels(light, [&](int x, int y, std::size_t p) { variance.pixels[p] = lightAround(light, x, y).variance; });
  return variance;
}

}  // namespace brisance
