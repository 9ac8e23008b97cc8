#include "render/fire_sampler.h"

#include <algorithm>

#include "render/fire_lights.h"

namespace brisance {
namespace {

double volumeOf(const Box3& box) {
  const Vec3d size = box.size();
  return size.x * size.y * size.z;
}

}  // namespace

FireSampler::FireSampler(const GasMedium& gas)
    : gas_(gas), densities_(gas.blockGlow().size, gas.blockGlow().origin, gas.blockGlow().cellSize) {
  const std::vector<GlowingBlock> glowing = glowingBlocks(gas);
  double sum = 0;
  for (const GlowingBlock& block : glowing) {
    blocks_.push_back(block.block);
    upTo_.push_back(sum += block.luminance);
  }
  for (const GlowingBlock& block : glowing) {
    const auto [i, j, k] = block.block;
    densities_(i, j, k) = static_cast<float>(block.luminance / sum / volumeOf(gas.blockBox(i, j, k)));
  }
}

FireSample FireSampler::sample(float choice, const Vec2<float>& across, float along) const {
  const auto found = std::upper_bound(upTo_.begin(), upTo_.end(), choice * upTo_.back());
  const auto [i, j, k] = blocks_[std::min<std::size_t>(found - upTo_.begin(), blocks_.size() - 1)];
  const Box3 box = gas_.blockBox(i, j, k);
  const Vec3f place(box.lower + box.size() * Vec3d(across.x, across.y, along));
  return {place, gas_.emissionAt(place), densities_(i, j, k)};
}

}  // namespace brisance
