#include "render/fire_lights.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace brisance {
namespace {

constexpr Vec3d luminanceWeights{0.2126, 0.7152, 0.0722};

/// Adds to `escape` a sixth of the share of light that leaves the gas from each block along an axis, both ways.
void addEscape(const Grid3<float>& extinction, int axis, Grid3<float>& escape) {
  const Vec3i n = extinction.size;
  const std::int64_t stride = extinction.stride(axis);
  const int length = n[axis], across = n[axis == 0 ? 1 : 0], along = n[axis == 2 ? 1 : 2];
  const std::int64_t acrossStride = extinction.stride(axis == 0 ? 1 : 0),
                     alongStride = extinction.stride(axis == 2 ? 1 : 2);
  const auto size = static_cast<float>(extinction.cellSize);
  const auto sweep = [&](std::int64_t from, std::int64_t step) {
    float depth = 0;  // from the edge of the gas to the near side of the block
    for (int i = 0; i < length; ++i) {
      const std::int64_t at = from + i * step;
      const float own = extinction.values[at] * size;
      escape.values[at] += std::exp(-(depth + 0.5f * own)) / 6;
      depth += own;
    }
  };
  for (int b = 0; b < along; ++b)
    for (int a = 0; a < across; ++a) {
      const std::int64_t line = a * acrossStride + b * alongStride;
      sweep(line, stride);
      sweep(line + (length - 1) * stride, -stride);
    }
}

double luminanceOf(std::span<const GlowingBlock> blocks) {
  double sum = 0;
  for (const GlowingBlock& block : blocks) sum += block.luminance;
  return sum;
}

FirePoint pointOf(std::span<const GlowingBlock> blocks) {
  Vec3d place, intensity;
  for (const GlowingBlock& block : blocks) {
    place += block.place * block.luminance;
    intensity += block.intensity;
  }
  const double sum = luminanceOf(blocks);
  place = place / sum;
  double spread = 0;
  for (const GlowingBlock& block : blocks) {
    const Vec3d off = block.place - place;
    spread += dot(off, off) * block.luminance;
  }
  return {Vec3f(place), Vec3f(intensity), static_cast<float>(std::sqrt(spread / sum))};
}

int longestAxis(std::span<const GlowingBlock> blocks) {
  Box3 box;
  for (const GlowingBlock& block : blocks) box.include(block.place);
  const Vec3d size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

void split(std::span<GlowingBlock> blocks, int count, std::vector<FirePoint>& points) {
  if (blocks.empty()) return;
  if (count == 1 || blocks.size() == 1) return points.push_back(pointOf(blocks));
  const int axis = longestAxis(blocks);
  std::stable_sort(blocks.begin(), blocks.end(),
                   [axis](const GlowingBlock& a, const GlowingBlock& b) { return a.place[axis] < b.place[axis]; });
  const int lowerCount = count / 2;
  const double wanted = luminanceOf(blocks) * lowerCount / count;
  std::size_t middle = 0;
  for (double sum = 0; middle + 1 < blocks.size() && sum < wanted; ++middle) sum += blocks[middle].luminance;
  split(blocks.first(middle), lowerCount, points);
  split(blocks.subspan(middle), count - lowerCount, points);
}

}  // namespace

Grid3<float> escapeOf(const Grid3<float>& extinction) {
  Grid3<float> escape(extinction.size, extinction.origin, extinction.cellSize);
  for (int axis = 0; axis < 3; ++axis) addEscape(extinction, axis, escape);
  return escape;
}

std::vector<GlowingBlock> glowingBlocks(const GasMedium& gas) {
  const Grid3<Vec3f>& glow = gas.blockGlow();
  const Grid3<float> escape = escapeOf(gas.blockExtinction());
  std::vector<GlowingBlock> blocks;
  for (int k = 0; k < glow.size.z; ++k)
    for (int j = 0; j < glow.size.y; ++j)
      for (int i = 0; i < glow.size.x; ++i) {
        const Vec3d intensity = Vec3d(glow(i, j, k)) * escape(i, j, k);
        const double luminance = dot(luminanceWeights, intensity);
        if (luminance > 0) blocks.push_back({{i, j, k}, glow.position(i, j, k), intensity, luminance});
      }
  return blocks;
}

std::vector<FirePoint> findFirePoints(const GasMedium& gas, int count) {
  std::vector<FirePoint> points;
  std::vector<GlowingBlock> blocks = glowingBlocks(gas);
  if (count > 0) split(blocks, count, points);
  // The glow of a cube has a root mean square distance of half an edge from its middle; a cluster of one block would be
  // a point without extent, infinitely bright where it lies.
  const auto least = static_cast<float>(gas.blockGlow().cellSize / 2);
  for (FirePoint& point : points) point.radius = std::max(point.radius, least);
  return points;
}

}  // namespace brisance
