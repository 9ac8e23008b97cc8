// Points shared between the cells around them and blurred by a separable filter, sparse where nothing lies: heat of
// burning particles (one channel), mass and colour for pictures (four).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/aligned.h"
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

/// One layer of cells: for each row j the amounts of its cells, those of one cell side by side.
class SplatLayer {
 public:
  SplatLayer(const Vec3i& size, int channels, int radius);
  float* row(int j) { return values_.data() + stride_ * j; }
  const float* row(int j) const { return values_.data() + stride_ * j; }
  /// Tells that some cells of row j are no longer empty.
  void use(int j, const CellSpan& cells) { used_[j].include(cells); }
  const CellSpan& used(int j) const { return used_[j]; }
  void clear();

 private:
  friend class LayerBlur;
  std::int64_t stride_;  // between rows
  AlignedVector<float> values_;
  std::vector<CellSpan> used_;
};

/// A field of `channels` values per cell, blurred along all axes. It is made layer by layer (constant k), kept between
/// the passes in memory of the caller's, and handed out row by row.
struct BlurTask {
  Vec3i size;
  int channels = 1;  ///< 1 or 4
  SymmetricFilter filter;
  /// Puts the field's layer k into an empty layer.
  std::function<void(int k, SplatLayer& layer)> fill;
  /// Memory of size.x floats for row (j, k) of a channel; the row's finish may overwrite it.
  std::function<float*(int channel, int j, int k)> memory;
  /// Takes row (j, k): cells outside `span` are zero; channel c's cell i is blurred[c][i]. Called once for every row.
  std::function<void(int j, int k, const CellSpan& span, const float* const* blurred)> finish;
};
/// The callbacks come from several threads at once, each for rows or layers of its own.
void blurSeparably(const BlurTask& task);

/// Adds to a layer its shares of the points, which are sorted by share[2].lower; `gain[axis]` multiplies each cell's
/// shares. The layer's row 0 begins at cell (`firstCell`, `firstRow`) of those that the points count. The sums are made
/// in the points' order.
template <int channels>
struct LayerSplat {
  const Binned<SplatPoint<channels>>& points;
  const std::array<std::vector<float>, 3>& gain;
  int firstCell = 0, firstRow = 0;
  void operator()(int k, SplatLayer& layer) const;
};

}  // namespace brisance
