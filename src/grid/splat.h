// Points shared between the eight cells around them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/counting_sort.h"
#include "base/math.h"
#include "grid/layer_rows.h"

namespace brisance {

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
using CellShares = std::array<AxisShare, 3>;

/// A point in the row of cells of its lower neighbours, the number of which says where it lies along y and z.
template <int channels>
struct SplatPoint {
  std::array<float, 3> fraction;
  std::int32_t lower;  ///< along x
  std::array<float, channels> amount;

  SplatPoint() = default;
  SplatPoint(const CellShares& share, const std::array<float, channels>& amount_)
      : fraction{share[0].fraction, share[1].fraction, share[2].fraction}, lower(share[0].lower), amount(amount_) {}
};

/// Number of the row of the lower neighbours along y and z.
inline std::int64_t rowOf(const AxisShare& y, const AxisShare& z, int rowsPerLayer) {
  return y.lower + static_cast<std::int64_t>(rowsPerLayer) * z.lower;
}

/// Adds points, sorted by rowOf, to the cells, layer after layer. The sums are made in the points' order.
template <int channels>
class LayerSplat {
 public:
  /// `gain[axis]` multiplies each cell's shares; `firstCell` is the first cell of the layers among those that the
  /// points count.
  LayerSplat(const Binned<SplatPoint<channels>>& points, std::array<std::vector<float>, 3> gain,
             const Vec3i& firstCell = {0, 0, 0});

  /// Adds what the points whose lower layer is k give to the given rows of layers k (near) and k + 1 (far). Both have a
  /// row more on either side, which holds nothing of use afterwards.
  void operator()(const CellSpan& rows, int k, LayerRows& near, LayerRows& far) const;

 private:
  void addRow(int j, int k, LayerRows& near, LayerRows& far) const;

  const Binned<SplatPoint<channels>>& points_;
  std::array<std::vector<float>, 3> gain_;  // and 0 for a cell beyond
  Vec3i firstCell_;
  int rowsPerLayer_;
};

}  // namespace brisance
