// A grid that is mostly one value: only bricks of 8x8x8 that differ from it are stored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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

/// Keeps the bricks in which some sample differs from the background.
template <class T>
SparseGrid<T> makeSparse(const Grid3<T>& dense, T background) {
  SparseGrid<T> sparse{dense.size, dense.origin, dense.cellSize, background, {}};
  for (int bk = 0; bk < dense.size.z; bk += 8)
    for (int bj = 0; bj < dense.size.y; bj += 8)
      for (int bi = 0; bi < dense.size.x; bi += 8) {
        typename SparseGrid<T>::Brick brick{{bi, bj, bk}, {}};
        brick.values.fill(background);
        bool differs = false;
        for (int k = bk; k < std::min(bk + 8, dense.size.z); ++k)
          for (int j = bj; j < std::min(bj + 8, dense.size.y); ++j)
            for (int i = bi; i < std::min(bi + 8, dense.size.x); ++i) {
              const T value = dense(i, j, k);
              brick.values[(i - bi) + 8 * ((j - bj) + 8 * (k - bk))] = value;
              differs = differs || !(value == background);
            }
        if (differs) sparse.bricks.push_back(brick);
      }
  return sparse;
}

}  // namespace brisance
