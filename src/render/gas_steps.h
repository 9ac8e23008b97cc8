// How ways go through the gas in steps: shared by those who add up light and those who draw collisions.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "render/gas_medium.h"

namespace brisance {

/// A way that passes less than this counts as passing nothing (appendix A.2 ends at an opacity of 0.999).
constexpr float seeThrough = 1 - 0.999f;

/// e^x for x <= 0 to 3e-7, by the bits of a float: 2^k times a polynomial of the rest.
inline float fastExp(float x) {
  constexpr float log2e = 1.44269504f;
  const float t = std::max(x * log2e, -126.0f);
  const float k = std::floor(t + 0.5f), r = (t - k) * 0.693147181f;
  const float fraction =
      1 + r * (1 + r * (0.5f + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
  return fraction * std::bit_cast<float>((static_cast<std::int32_t>(k) + 127) << 23);
}

/// Where a way through the fine grid is, in cells.
struct GridWay {
  Vec3f origin, direction;  ///< [cells], [cells/m]
  Vec3f at(float distance) const { return origin + direction * distance; }
  /// The block around a place.
  Vec3i block(const Vec3f& place, const Vec3i& blocks) const {
    const auto along = [&](int axis) {
      return std::clamp(static_cast<int>(place[axis]) / GasMedium::blockCells, 0, blocks[axis] - 1);
    };
    return {along(0), along(1), along(2)};
  }
  /// The distance [m] at which the way leaves a block; outermost blocks have no end outwards.
  float leaves(const Vec3i& block, const Vec3i& blocks) const {
    float nearest = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const bool forward = direction[axis] > 0;
      if (direction[axis] == 0 || (forward ? block[axis] + 1 == blocks[axis] : block[axis] == 0)) continue;
      const auto face = static_cast<float>(GasMedium::blockCells * (forward ? block[axis] + 1 : block[axis]));
      nearest = std::min(nearest, (face - origin[axis]) / direction[axis]);
    }
    return nearest;
  }
};

/// A piece of a way inside one block that holds gas.
struct GasStep {
  Vec3f place;     ///< its middle [cells]
  float from, to;  ///< [m] along the way
  Vec3i block;
};

/// Calls step(GasStep) along the path, front to back, until it returns false. Step n covers the distances from
/// (n - 1 + phase) to (n + phase) steps, cut to the path: the steps of neighbouring segments of a ray join without gap
/// or overlap.
template <class Step>
void GasMedium::alongSteps(GasPath path, const Step& step) const {
  if (!clip(path)) return;
  const float perCell = 1 / cellSize_;
  const GridWay way{(path.origin - origin_) * perCell, path.direction * perCell};
  float n = std::floor(path.near / step_ - path.phase) + 1;
  for (float from = path.near; from < path.far; n += 1) {
    const float to = std::min((n + path.phase) * step_, path.far);
    const Vec3f place = way.at(0.5f * (from + to));
    const Vec3i block = way.block(place, blockLargest_.size);
    const float out = way.leaves(block, blockLargest_.size);
    if (blockLargest_(block.x, block.y, block.z) <= 0) {
      if (out >= path.far) break;
      n = std::max(n, std::floor(out / step_ - path.phase));
      from = std::max(to, (n + path.phase) * step_);
      continue;
    }
    if (!step({place, from, to, block})) return;
    from = to;
    // The further steps whose middle lies in this block need not look it up again.
    for (; from < path.far; n += 1) {
      const float end = std::min((n + 1 + path.phase) * step_, path.far), middle = 0.5f * (from + end);
      if (middle >= out) break;
      if (!step({way.at(middle), from, end, block})) return;
      from = end;
    }
  }
}

}  // namespace brisance
