// A grid that is mostly one value: only bricks of 8x8x8 that differ from it are stored.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/grid3.h"

namespace brisance {

constexpr int brickSide = 8;

template <class T>
using BrickValues = std::array<T, brickSide * brickSide * brickSide>;

/// Bricks of 8^3 samples in order of their place (x fastest). Sample (i, j, k) lies at origin + (i, j, k) * cellSize.
template <class T>
struct SparseGrid {
  struct Brick {
    Vec3i corner;           ///< first sample of the brick: a multiple of 8 along each axis
    BrickValues<T> values;  ///< i fastest; samples outside `size` hold the background
    friend bool operator==(const Brick&, const Brick&) = default;
  };
  Vec3i size;
  Vec3d origin;         ///< [m] of sample (0, 0, 0)
  double cellSize = 1;  ///< [m]
  T background{};
  std::vector<Brick> bricks;

  friend bool operator==(const SparseGrid&, const SparseGrid&) = default;
};

/// Calls visit(first sample's place, i, j, k, count) for each row of a brick's samples inside `size`.
template <class Visit>
void forRowsOf(const Vec3i& corner, const Vec3i& size, const Visit& visit) {
  constexpr int side = brickSide;
  const Vec3i end = min(corner + Vec3i(side, side, side), size);
  for (int k = corner.z; k < end.z; ++k)
    for (int j = corner.y; j < end.y; ++j)
      visit(side * ((j - corner.y) + side * (k - corner.z)), corner.x, j, k, end.x - corner.x);
}

/// The same for each sample: visit(sample's place, i, j, k).
template <class Visit>
void forSamplesOf(const Vec3i& corner, const Vec3i& size, const Visit& visit) {
  forRowsOf(corner, size, [&](int sample, int i, int j, int k, int count) {
    for (int n = 0; n < count; ++n) visit(sample + n, i + n, j, k);
  });
}

/// The background where there is no brick.
template <class T>
Grid3<T> makeDense(const SparseGrid<T>& sparse) {
  Grid3<T> dense(sparse.size, sparse.origin, sparse.cellSize, sparse.background);
  for (const auto& brick : sparse.bricks)
    forRowsOf(brick.corner, sparse.size, [&](int sample, int i, int j, int k, int count) {
      std::copy_n(&brick.values[sample], count, &dense(i, j, k));
    });
  return dense;
}

}  // namespace brisance
