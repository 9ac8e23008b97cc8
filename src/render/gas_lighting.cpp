// Smoke that shades itself: what the lights send to each block of the gas.
#include <algorithm>

#include "base/parallel.h"
#include "render/fire_lights.h"
#include "render/gas_medium.h"
#include "render/lights.h"

namespace brisance {
namespace {

/// A light's I_s is its irradiance over pi; a share of 1/(4 pi) of what is scattered alike in all directions goes each
/// way.
constexpr float isotropicShare = 0.25f;

/// Whether a place between block centres may read block (i, j, k) for gas: it or a neighbour holds some.
bool isRead(const Grid3<float>& largest, int i, int j, int k) {
  for (int z = std::max(k - 1, 0); z <= std::min(k + 1, largest.size.z - 1); ++z)
    for (int y = std::max(j - 1, 0); y <= std::min(j + 1, largest.size.y - 1); ++y)
      for (int x = std::max(i - 1, 0); x <= std::min(i + 1, largest.size.x - 1); ++x)
        if (largest(x, y, z) > 0) return true;
  return false;
}

}  // namespace

/// Light scattered by gas comes from all around: I_s counts light from one side, so lights count by `isotropicShare`.
Vec3f GasMedium::arriving(const Vec3f& place, const std::vector<LightSource>& lights) const {
  Vec3f sum;
  for (const LightSource& light : lights) {
    const ArrivingLight at = light.at(place);
    sum += at.intensity * (isotropicShare * roughTransmittance({place, at.toLight, 0, at.distance}));
  }
  return sum;
}

void GasMedium::illuminate(const Vec3f& ambientLight, const std::vector<LightSource>& lights) {
  const Grid3<float>&largest = blockLargest_, openness = escapeOf(blockExtinction_);
  parallelFor(0, static_cast<std::int64_t>(largest.size.y) * largest.size.z, 1,
              [&](std::int64_t first, std::int64_t last) {
                for (std::int64_t row = first; row < last; ++row)
                  for (int i = 0; i < largest.size.x; ++i) {
                    const int j = static_cast<int>(row % largest.size.y), k = static_cast<int>(row / largest.size.y);
                    if (isRead(largest, i, j, k))
                      blockScattered_(i, j, k) = optics_.scattered(ambientLight * openness(i, j, k) +
                                                                   arriving(Vec3f(largest.position(i, j, k)), lights));
                  }
              });
  bakeScattered();
}

}  // namespace brisance
