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

/// e^x for x <= 0 to 3e-7, by the bits of a float: 2^k times a polynomial of the rest, ln(2)^n / n! its coefficients.
inline float fastExp(float x) {
  constexpr float log2e = 1.44269504f;
  const float t = std::max(x * log2e, -126.0f);
  const auto k = static_cast<std::int32_t>(t - 0.5f);  // the nearest whole number, t being negative
  const float r = t - static_cast<float>(k);
  const float fraction =
      1 +
      r * (0.693147181f + r * (0.240226507f + r * (0.0555041087f +
                                                   r * (0.00961812911f + r * (0.00133335581f + r * 0.000154035304f)))));
  return fraction * std::bit_cast<float>((k + 127) << 23);
}

/// A walk along a way from block to block (Amanatides & Woo 1987).
class BlockWalk {
 public:
  /// `place` [cells] lies on the way at `distance` [m]; `direction` in cells per metre.
  BlockWalk(const Vec3f& place, const Vec3f& direction, float distance, const Vec3i& blocks) {
    constexpr int cells = GasBrick::cells;
    constexpr float never = std::numeric_limits<float>::infinity();
    const int strides[3] = {1, blocks.x, blocks.x * blocks.y};
    for (int axis = 0; axis < 3; ++axis) {
      const float along = direction[axis];
      block_[axis] = std::clamp(static_cast<int>(place[axis]) / cells, 0, blocks[axis] - 1);
      number_ += block_[axis] * strides[axis];
      const bool forward = along > 0;
      step_[axis] = forward ? 1 : -1;
      stride_[axis] = step_[axis] * strides[axis];
      left_[axis] = along == 0 ? 0 : forward ? blocks[axis] - 1 - block_[axis] : block_[axis];
      width_[axis] = static_cast<float>(cells) / std::abs(along);
      const auto face = static_cast<float>(cells * (block_[axis] + forward));
      leaves_[axis] = left_[axis] > 0 ? distance + (face - place[axis]) / along : never;
    }
  }
  int number() const { return number_; }
  Vec3f lower() const { return Vec3f(block_) * static_cast<float>(GasBrick::cells); }  ///< its first cell
  /// The distance [m] at which the way leaves the block; outermost blocks have no end outwards.
  float leaves() const { return std::min({leaves_[0], leaves_[1], leaves_[2]}); }
  void next() {
    const int axis = leaves_[0] <= leaves_[1] ? (leaves_[0] <= leaves_[2] ? 0 : 2) : leaves_[1] <= leaves_[2] ? 1 : 2;
    number_ += stride_[axis];
    block_[axis] += step_[axis];
    leaves_[axis] = --left_[axis] > 0 ? leaves_[axis] + width_[axis] : std::numeric_limits<float>::infinity();
  }

 private:
  int number_ = 0;
  Vec3i block_;
  int step_[3], stride_[3], left_[3];
  float width_[3], leaves_[3];
};

/// Some steps of a way, front to back, with what the gas is there. Lanes from `count` on hold nothing of meaning.
struct GasSteps {
  static constexpr int lanes = 16;
  template <class T>
  struct alignas(64) Lanes {
    T value[2 * lanes];  // whole vectors are written, over what does not count yet
    T& operator[](int n) { return value[n]; }
    const T& operator[](int n) const { return value[n]; }
  };
  int count = 0;
  Lanes<float> number;                  ///< of the step, on the grid that all ways with this phase share
  Lanes<std::int32_t> brick;            ///< that holds its middle
  Lanes<float> lowerX, lowerY, lowerZ;  ///< [cells] of that brick
  Lanes<float> from, to;                ///< [m] along the way
  Lanes<float> shareX, shareY, shareZ;  ///< of the middle between samples
  Lanes<std::int32_t> first;            ///< sample of the brick
  GasSample sample[lanes];
  Lanes<float> density, depth;  ///< depth: extinction times length
  Lanes<float> passing;         ///< e^-depth
  Lanes<float> perDensity;      ///< 1 / density, or 0 where there is none

  float length(int n) const { return to[n] - from[n]; }
  float middle(int n) const { return 0.5f * (from[n] + to[n]); }
  /// Adds up to `wanted` steps inside one brick, from step `n` on; returns how many found room.
  int add(float n, int wanted, std::int32_t inBrick, const Vec3f& lower) {
    for (int lane = 0; lane < lanes; ++lane) number[count + lane] = n + static_cast<float>(lane);
    for (int lane = 0; lane < lanes; ++lane) brick[count + lane] = inBrick;
    for (int lane = 0; lane < lanes; ++lane) lowerX[count + lane] = lower.x;
    for (int lane = 0; lane < lanes; ++lane) lowerY[count + lane] = lower.y;
    for (int lane = 0; lane < lanes; ++lane) lowerZ[count + lane] = lower.z;
    const int added = std::min(wanted, lanes - count);
    count += added;
    return added;
  }
};

/// The lanes' places, samples and opacities.
inline void GasMedium::look(const GasPath& path, GasSteps& steps) const {
  const float perCell = 1 / cellSize_;
  const Vec3f origin = (path.origin - origin_) * perCell, direction = path.direction * perCell;
  constexpr float inside = GasBrick::cells - 1e-5f;
  const auto place = [&](float start, float slope, float middle, float lower) {
    return std::min(std::max(start + slope * middle - lower, 0.0f), inside);
  };
  for (int n = 0; n < GasSteps::lanes; ++n) {
    const float from = std::max((steps.number[n] - 1 + path.phase) * step_, path.near);
    const float to = std::min((steps.number[n] + path.phase) * step_, path.far);
    steps.from[n] = from;
    steps.to[n] = to;
    const float middle = 0.5f * (from + to);
    const float x = place(origin.x, direction.x, middle, steps.lowerX[n]),
                y = place(origin.y, direction.y, middle, steps.lowerY[n]),
                z = place(origin.z, direction.z, middle, steps.lowerZ[n]);
    const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y), k = static_cast<std::int32_t>(z);
    steps.shareX[n] = x - static_cast<float>(i);
    steps.shareY[n] = y - static_cast<float>(j);
    steps.shareZ[n] = z - static_cast<float>(k);
    steps.first[n] = GasBrick::index(i, j, k);
  }
  for (int n = 0; n < steps.count; ++n) {
    steps.sample[n] =
        memory_.bricks[steps.brick[n]].between(steps.first[n], steps.shareX[n], steps.shareY[n], steps.shareZ[n]);
    steps.density[n] = steps.sample[n].density();
  }
  for (int n = 0; n < GasSteps::lanes; ++n) {
    const float density = n < steps.count ? steps.density[n] : 0;
    steps.depth[n] = optics_.extinction(density) * (steps.to[n] - steps.from[n]);
    steps.passing[n] = fastExp(-steps.depth[n]);
    steps.perDensity[n] = density > 0 ? 1 / density : 0;
  }
}

/// Calls use(GasSteps) along the path, front to back, until it returns false. Step n covers the distances from
/// (n - 1 + phase) to (n + phase) steps, cut to the path: the steps of neighbouring segments of a ray join without gap
/// or overlap. Steps whose middle lies where there is no gas are left out.
template <class Use>
void GasMedium::alongSteps(GasPath path, const Use& use) const {
  if (!clip(path)) return;
  const float perCell = 1 / cellSize_, perStep = 1 / step_;
  BlockWalk walk((path.origin + path.direction * path.near - origin_) * perCell, path.direction * perCell, path.near,
                 blockLargest_.size);
  const float beyondLast = std::ceil(path.far * perStep - path.phase) + 1;
  GasSteps steps;
  float n = std::floor(path.near * perStep - path.phase) + 1;
  for (;;) {
    const float leaves = walk.leaves();
    const bool last = leaves >= path.far;
    // The first step whose middle lies beyond the block.
    const float end = last ? beyondLast : std::min(std::ceil(leaves * perStep + 0.5f - path.phase), beyondLast);
    const std::int32_t brick = brickOf_[walk.number()];
    for (int wanted = brick < 0 ? 0 : static_cast<int>(end - n); wanted > 0;) {
      const int added = steps.add(end - static_cast<float>(wanted), wanted, brick, walk.lower());
      wanted -= added;
      if (steps.count < GasSteps::lanes) break;
      look(path, steps);
      if (!use(steps)) return;
      steps.count = 0;
    }
    n = std::max(n, end);
    if (last) break;
    walk.next();
  }
  if (steps.count == 0) return;
  look(path, steps);
  use(steps);
}

}  // namespace brisance
