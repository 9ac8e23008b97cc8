// Points shared between the cells around them and blurred by a separable filter, sparse where nothing lies: heat of
// burning particles (one channel), mass and colour for pictures (four).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/counting_sort.h"
#include "base/math.h"
#include "grid/symmetric_filter.h"

namespace brisance {

/// Cells [first, end) of a row; none when end <= first.
struct CellSpan {
  int first = 0, end = 0;
  bool empty() const { return end <= first; }
  void include(const CellSpan& other) {
    if (other.empty()) return;
    *this = empty() ? other : CellSpan{std::min(first, other.first), std::max(end, other.end)};
  }
};

/// Where a point lies along an axis: `fraction` of it belongs to the cell after `lower`, the rest to `lower`.
struct AxisShare {
  std::int32_t lower = 0;
  float fraction = 0;
};
/// `place` in cells, 0 being the first cell's centre; all belongs to the outermost cell beyond its centre.
inline AxisShare axisShare(double place, int cells) {
  const double inside = std::min(place > 0 ? place : 0.0, cells - 1.0);  // not a number: the first cell
  const int lower = std::min(static_cast<int>(inside), std::max(0, cells - 2));
  return {lower, static_cast<float>(inside - lower)};
}

template <int channels>
struct SplatPoint {
  std::array<AxisShare, 3> share;
  std::array<float, channels> amount;
};

/// A field of `channels` values per cell, blurred along all axes. It is made row by row, some rows more than once, and
/// handed out row by row; what lies in between fits a cache.
struct BlurTask {
  Vec3i size;
  int channels = 1;  ///< 1 or 4
  SymmetricFilter filter;
  /// Adds the field's row (j, k) to empty cells, the channels of one cell side by side, and tells which it has filled.
  std::function<CellSpan(int j, int k, float* cells)> fill;
  /// Takes row (j, k): cells outside `span` are zero; channel c's cell i is blurred[c][i]. Called once for every row.
  std::function<void(int j, int k, const CellSpan& span, float* const* blurred)> finish;
};
/// The callbacks come from several threads at once, each for rows of its own.
void blurSeparably(const BlurTask& task);

/// Points in order of the row of cells of their lower neighbours.
template <int channels>
std::int64_t rowOf(const SplatPoint<channels>& point, int rowsPerLayer) {
  return point.share[1].lower + static_cast<std::int64_t>(rowsPerLayer) * point.share[2].lower;
}

/// Adds to row (j, k) its shares of the points, which are sorted by rowOf; `gain[axis]` multiplies each cell's shares.
/// `cells` begins at cell `firstCell` of those that the points count. The sums are made in the points' order.
template <int channels>
struct RowSplat {
  const Binned<SplatPoint<channels>>& points;
  const std::array<std::vector<float>, 3>& gain;
  int firstCell = 0;
  CellSpan operator()(int j, int k, float* cells) const;
};

}  // namespace brisance
