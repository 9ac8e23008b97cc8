#include "render/fire_sampler.h"

#include <algorithm>

#include "base/parallel.h"
#include "render/fire_lights.h"

namespace brisance {
namespace {

constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};

/// The entry of a rising list in which `wanted` falls.
template <class List>
std::size_t entryOf(const List& upTo, double wanted) {
  const auto found = std::upper_bound(upTo.begin(), upTo.end(), wanted);
  return std::min<std::size_t>(found - upTo.begin(), upTo.size() - 1);
}

}  // namespace

FireSampler::FireSampler(const GasMedium& gas)
    : gas_(gas), numbers_(gas.blockGlow().size, gas.blockGlow().origin, gas.blockGlow().cellSize, -1) {
  const std::vector<GlowingBlock> glowing = glowingBlocks(gas);
  std::vector<Block> blocks(glowing.size());
  parallelFor(0, std::ssize(glowing), 16, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      blocks[n].block = glowing[n].block;
      blocks[n].share = weighCells(blocks[n]) > 0 ? static_cast<float>(glowing[n].luminance) : 0;
    }
  });
  double all = 0, sum = 0;
  for (const Block& block : blocks) all += block.share;
  for (Block& block : blocks) {
    if (!(block.share > 0)) continue;
    upTo_.push_back((sum += block.share) / all);
    block.share = static_cast<float>(block.share / all);
    numbers_(block.block.x, block.block.y, block.block.z) = static_cast<int>(blocks_.size());
    blocks_.push_back(block);
  }
}

/// By what the middle of each cell gives off, which is the mean of its corners. Returns the sum.
float FireSampler::weighCells(Block& block) const {
  float sum = 0;
  for (int cell = 0; cell < cellsOfBlock; ++cell) {
    const Vec3i lower = cornerOf(block, cell);
    if (gas_.isBetweenSamples(lower))
      sum += dot(luminanceWeights, gas_.emissionAtCell(Vec3f(lower) + Vec3f(0.5f, 0.5f, 0.5f)));
    block.upTo[cell] = sum;
  }
  if (sum > 0)
    for (float& upTo : block.upTo) upTo /= sum;
  return sum;
}

Vec3i FireSampler::cornerOf(const Block& block, int cell) {
  return block.block * side + Vec3i(cell % side, cell / side % side, cell / (side * side));
}

FireSample FireSampler::sample(const Vec2<float>& choice, const Vec2<float>& across, float along) const {
  const Block& block = blocks_[entryOf(upTo_, choice.x)];
  const auto cell = static_cast<int>(entryOf(block.upTo, choice.y));
  const Vec3f place = Vec3f(cornerOf(block, cell)) + Vec3f(across.x, across.y, along);
  return {gas_.placeOf(place), gas_.emissionAtCell(place),
          density(static_cast<std::int32_t>(numbers_.index(block.block.x, block.block.y, block.block.z)), place),
          gas_.extinctionAtCell(place)};
}

float FireSampler::density(std::int32_t block, const Vec3f& place) const {
  const int number = numbers_.values[block];
  if (number < 0 || std::min({place.x, place.y, place.z}) < 0) return 0;
  const Block& found = blocks_[number];
  const auto along = [&](int axis) {
    return std::clamp(static_cast<int>(place[axis]) - side * found.block[axis], 0, side - 1);
  };
  const float size = gas_.cellSize();
  return found.share * found.cellShare(along(0) + side * (along(1) + side * along(2))) / (size * size * size);
}

}  // namespace brisance
