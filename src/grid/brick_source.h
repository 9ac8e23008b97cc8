// A grid as bricks that are made when they are asked for: what a SparseGrid holds, without the memory for it.
#pragma once

#include <algorithm>
#include <cstring>
#include <functional>

#include "base/parallel.h"
#include "grid/sparse_grid.h"

namespace brisance {

/// The bricks that may differ from the background; all others are known to be it.
template <class T>
struct BrickSource {
  Vec3i size;
  Vec3d origin;         ///< [m] of sample (0, 0, 0)
  double cellSize = 1;  ///< [m]
  T background{};
  std::vector<Vec3i> corners;  ///< as SparseGrid::Brick's
  /// All samples of the brick at corners[n], i fastest, the background outside `size`. Called from several threads.
  std::function<void(std::size_t n, BrickValues<T>& values)> read;
};

/// Of all bricks of a box, in their order.
std::vector<Vec3i> cornersOfBricks(const Vec3i& size);

/// Every brick of a box. `fillRow(values, i, j, k, count)` makes the samples from (i, j, k) on along i; `place` says
/// size, origin and cell size. Both are kept by the source.
template <class T, class Place, class FillRow>
BrickSource<T> bricksOf(const Grid3<Place>& place, T background, FillRow fillRow) {
  BrickSource<T> source{place.size, place.origin, place.cellSize, background, cornersOfBricks(place.size), {}};
  source.read = [corners = source.corners, size = place.size, background, fillRow](std::size_t n,
                                                                                   BrickValues<T>& values) {
    const Vec3i inside = size - corners[n];
    if (std::min({inside.x, inside.y, inside.z}) < brickSide) values.fill(background);
    forRowsOf(corners[n], size,
              [&](int sample, int i, int j, int k, int count) { fillRow(values.data() + sample, i, j, k, count); });
  };
  return source;
}

/// The source reads from the grid, which must outlive it.
template <class T>
BrickSource<T> bricksOf(const SparseGrid<T>& grid) {
  BrickSource<T> source{grid.size, grid.origin, grid.cellSize, grid.background, {}, {}};
  source.corners.reserve(grid.bricks.size());
  for (const auto& brick : grid.bricks) source.corners.push_back(brick.corner);
  source.read = [&grid](std::size_t n, BrickValues<T>& values) { values = grid.bricks[n].values; };
  return source;
}

/// Whether they are the same to the bit.
template <class T>
bool sameBits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Keeps the bricks in which some sample differs from the background by a bit.
template <class T>
SparseGrid<T> makeSparse(const BrickSource<T>& source) {
  constexpr std::int64_t grain = 64;
  const std::int64_t count = std::ssize(source.corners);
  std::vector<std::uint8_t> differs(count);
  parallelFor(0, count, grain, [&](std::int64_t first, std::int64_t last) {
    BrickValues<T> values;
    for (std::int64_t n = first; n < last; ++n) {
      source.read(n, values);
      differs[n] = !std::all_of(values.begin(), values.end(),
                                [&](const T& value) { return sameBits(value, source.background); });
    }
  });
  std::vector<std::int64_t> kept;
  for (std::int64_t n = 0; n < count; ++n)
    if (differs[n]) kept.push_back(n);
  SparseGrid<T> sparse{source.size, source.origin, source.cellSize, source.background, {}};
  sparse.bricks.resize(kept.size());
  parallelFor(0, std::ssize(kept), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      sparse.bricks[n].corner = source.corners[kept[n]];
      source.read(kept[n], sparse.bricks[n].values);
    }
  });
  return sparse;
}

/// Rows of bricks are too short for the processor to see where they lead: fetches the one that the next brick along z
/// will ask for, since files are packed in that order.
template <class T>
void fetchForNextBrick(const Grid3<T>& dense, int i, int j, int k, int count) {
  if (k + brickSide >= dense.size.z) return;
  const T* row = &dense.values[dense.index(i, j, k + brickSide)];
  __builtin_prefetch(row);
  __builtin_prefetch(row + count - 1);
}

/// All samples of the grid, which must outlive it.
template <class T>
BrickSource<T> denseBricks(const Grid3<T>& dense, T background) {
  return bricksOf<T>(dense, background, [&dense](T* values, int i, int j, int k, int count) {
    const T* row = &dense.values[dense.index(i, j, k)];
    fetchForNextBrick(dense, i, j, k, count);
    if (count == brickSide)
      std::memcpy(static_cast<void*>(values), row, brickSide * sizeof(T));  // of known size: no call
    else
      std::copy_n(row, count, values);
  });
}

template <class T>
SparseGrid<T> makeSparse(const Grid3<T>& dense, T background) {
  return makeSparse(denseBricks(dense, background));
}

}  // namespace brisance
