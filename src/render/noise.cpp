#include "render/noise.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "render/sample_sequence.h"

namespace brisance {
namespace {

constexpr int latticePeriod = 256;
using Shuffle = std::array<std::uint8_t, latticePeriod>;

/// The numbers 0 .. 255 in random order (Fisher and Yates), always the same: a pattern is part of the scene's look.
const Shuffle& shuffle() {
  static const Shuffle table = [] {
    NumberRun random(0);
    Shuffle order;
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random() * static_cast<float>(i + 1))]);
    return order;
  }();
  return table;
}

/// Towards the middles of a cube's twelve edges: no gradient lies along an axis, where it would be seen (Perlin 2002).
constexpr std::array<Vec3d, 12> gradients{Vec3d{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                          {1, 0, 1},      {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                          {0, 1, 1},      {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};

/// What the gradient of a lattice point has become at an offset from it.
double pull(std::int64_t x, std::int64_t y, std::int64_t z, const Vec3d& offset) {
  const Shuffle& next = shuffle();
  const auto wrapped = [](std::int64_t i) { return static_cast<std::size_t>(i & (latticePeriod - 1)); };
  const std::size_t which = next[wrapped(next[wrapped(next[wrapped(x)] + y)] + z)];
  return dot(gradients[which % gradients.size()], offset);
}

/// 6t^5 - 15t^4 + 10t^3: first and second derivative are 0 at 0 and 1.
double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

double mixed(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

double gradientNoise(const Vec3d& place) {
  const Vec3d floor(std::floor(place.x), std::floor(place.y), std::floor(place.z));
  const auto x = static_cast<std::int64_t>(floor.x), y = static_cast<std::int64_t>(floor.y),
             z = static_cast<std::int64_t>(floor.z);
  const Vec3d t = place - floor;
  const auto line = [&](int j, int k) {
    return mixed(pull(x, y + j, z + k, {t.x, t.y - j, t.z - k}), pull(x + 1, y + j, z + k, {t.x - 1, t.y - j, t.z - k}),
                 fade(t.x));
  };
  const auto plane = [&](int k) { return mixed(line(0, k), line(1, k), fade(t.y)); };
  return mixed(plane(0), plane(1), fade(t.z));
}

double harmonicNoise(const Vec3d& place, const NoiseHarmonics& harmonics) {
  double sum = 0, weight = 1, scale = 1;
  for (int i = 0; i < harmonics.count; ++i) {
    sum += gradientNoise(place * scale) * weight;
    weight /= harmonics.alpha;
    scale *= harmonics.beta;
  }
  return sum;
}

}  // namespace brisance
