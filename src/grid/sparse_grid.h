// A grid that is mostly one value: only bricks of 8x8x8 that differ from it are stored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "grid/grid3.h"

namespace brisance {

/// Bricks of 8^3 samples in order of their place (x fastest). Sample (i, j, k) lies at origin + (i, j, k) * cellSize.
template <class T>
struct SparseGrid {
  struct Brick {
    Vec3i corner;               ///< first sample of the brick: a multiple of 8 along each axis
    std::array<T, 512> values;  ///< i fastest; samples outside `size` hold the background
    friend bool operator==(const Brick&, const Brick&) = default;
  };
  Vec3i size;
  Vec3d origin;         ///< [m] of sample (0, 0, 0)
  double cellSize = 1;  ///< [m]
  T background{};
  std::vector<Brick> bricks;

  friend bool operator==(const SparseGrid&, const SparseGrid&) = default;
};

namespace detail {
/// Calls visit(sample of the brick, i, j, k) for those of a brick's samples that lie inside `size`, until it says
/// false; whether it never did.
template <class Visit>
bool forSamplesOf(const Vec3i& corner, const Vec3i& size, const Visit& visit) {
  const Vec3i end = min(corner + Vec3i(8, 8, 8), size);
  for (int k = corner.z; k < end.z; ++k)
    for (int j = corner.y; j < end.y; ++j)
      for (int i = corner.x; i < end.x; ++i)
        if (!visit((i - corner.x) + 8 * ((j - corner.y) + 8 * (k - corner.z)), i, j, k)) return false;
  return true;
}

/// Corners of the bricks that `differs` is true for, in their order.
template <class Differs>
std::vector<Vec3i> brickCorners(const Vec3i& size, const Differs& differs) {
  const int layers = (size.z + 7) / 8;
  std::vector<std::vector<Vec3i>> ofLayer(layers);
  parallelFor(0, layers, 1, [&](std::int64_t first, std::int64_t last) {
    for (int n = static_cast<int>(first); n < last; ++n)
      for (int j = 0; j < size.y; j += 8)
        for (int i = 0; i < size.x; i += 8)
          if (differs(Vec3i(i, j, 8 * n))) ofLayer[n].emplace_back(i, j, 8 * n);
  });
  std::vector<Vec3i> corners;
  for (const auto& layer : ofLayer) corners.insert(corners.end(), layer.begin(), layer.end());
  return corners;
}
}  // namespace detail

/// Keeps the bricks in which some sample differs from the background. `valueAt(i, j, k)` is called from several threads
/// and may be called twice for a sample; `place` says size, origin and cell size.
template <class T, class Place, class ValueAt>
SparseGrid<T> makeSparse(const Grid3<Place>& place, T background, const ValueAt& valueAt) {
  const Vec3i size = place.size;
  const std::vector<Vec3i> corners = detail::brickCorners(size, [&](const Vec3i& corner) {
    return !detail::forSamplesOf(corner, size,
                                 [&](int, int i, int j, int k) { return valueAt(i, j, k) == background; });
  });
  SparseGrid<T> sparse{size, place.origin, place.cellSize, background, {}};
  sparse.bricks.resize(corners.size());
  constexpr std::int64_t grain = 64;
  parallelFor(0, std::ssize(corners), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      auto& brick = sparse.bricks[n];
      brick.corner = corners[n];
      brick.values.fill(background);
      detail::forSamplesOf(brick.corner, size, [&](int sample, int i, int j, int k) {
        brick.values[sample] = valueAt(i, j, k);
        return true;
      });
    }
  });
  return sparse;
}

/// Keeps the bricks in which some sample differs from the background.
template <class T>
SparseGrid<T> makeSparse(const Grid3<T>& dense, T background) {
  return makeSparse(dense, background, [&](int i, int j, int k) { return dense(i, j, k); });
}

}  // namespace brisance
