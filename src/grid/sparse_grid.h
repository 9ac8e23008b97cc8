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
/// The bricks of one layer of them, from k = `bk` on, in which some sample differs from the background.
template <class T, class ValueAt>
std::vector<typename SparseGrid<T>::Brick> bricksOfLayer(const Vec3i& size, const T& background, int bk,
                                                         const ValueAt& valueAt) {
  std::vector<typename SparseGrid<T>::Brick> bricks;
  for (int bj = 0; bj < size.y; bj += 8)
    for (int bi = 0; bi < size.x; bi += 8) {
      typename SparseGrid<T>::Brick brick{{bi, bj, bk}, {}};
      brick.values.fill(background);
      bool differs = false;
      for (int k = bk; k < std::min(bk + 8, size.z); ++k)
        for (int j = bj; j < std::min(bj + 8, size.y); ++j)
          for (int i = bi; i < std::min(bi + 8, size.x); ++i) {
            const T value = valueAt(i, j, k);
            brick.values[(i - bi) + 8 * ((j - bj) + 8 * (k - bk))] = value;
            differs = differs || !(value == background);
          }
      if (differs) bricks.push_back(brick);
    }
  return bricks;
}
}  // namespace detail

/// Keeps the bricks in which some sample differs from the background; `valueAt(i, j, k)` is called from several
/// threads. `place` says size, origin and cell size.
template <class T, class Place, class ValueAt>
SparseGrid<T> makeSparse(const Grid3<Place>& place, T background, const ValueAt& valueAt) {
  const int layers = (place.size.z + 7) / 8;
  std::vector<std::vector<typename SparseGrid<T>::Brick>> ofLayer(layers);
  parallelFor(0, layers, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n)
      ofLayer[n] = detail::bricksOfLayer(place.size, background, static_cast<int>(8 * n), valueAt);
  });
  SparseGrid<T> sparse{place.size, place.origin, place.cellSize, background, {}};
  std::vector<std::size_t> start(layers + 1, 0);
  for (int n = 0; n < layers; ++n) start[n + 1] = start[n] + ofLayer[n].size();
  sparse.bricks.resize(start[layers]);
  parallelFor(0, layers, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n)
      std::copy(ofLayer[n].begin(), ofLayer[n].end(), sparse.bricks.begin() + static_cast<std::ptrdiff_t>(start[n]));
  });
  return sparse;
}

/// Keeps the bricks in which some sample differs from the background.
template <class T>
SparseGrid<T> makeSparse(const Grid3<T>& dense, T background) {
  return makeSparse(dense, background, [&](int i, int j, int k) { return dense(i, j, k); });
}

}  // namespace brisance
