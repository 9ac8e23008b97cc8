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
using CellShares = std::array<AxisShare, 3>;

/// Rows of cells along x by number: bands of neighbouring rows, one layer of a band after the other. So what lies in a
/// few neighbouring rows is read from one layer to the next as it lies in memory.
class BandedRows {
 public:
  BandedRows(int rowsPerLayer, int layers) : layers_(layers), bands_((rowsPerLayer + inBand - 1) / inBand) {}
  std::int64_t count() const { return std::int64_t{inBand} * bands_ * layers_; }
  std::int32_t operator()(int j, int k) const { return (j & -inBand) * layers_ + inBand * k + (j & (inBand - 1)); }

 private:
  static constexpr int inBand = 4;  // a power of two, of the narrowest strips of rows that a blur goes over
  int layers_, bands_;
};

/// The same for a run of points, one array per number, so that loops over them become loops over vectors.
struct ShareRun {
  std::int32_t lower[3][sortRun];
  float fraction[3][sortRun];

  /// place(n) of points n = 0 .. count - 1 in cells along an axis, 0 being the first cell's centre; all belongs to the
  /// outermost cell beyond its centre. Calls note(n, at) with each place.
  template <class Place, class Note>
  void set(int axis, int count, int cells, const Place& place, const Note& note) {
    const double lastCentre = cells - 1.0;
    const std::int32_t lastLower = std::max(0, cells - 2);
    std::int32_t* lowers = lower[axis];
    float* fractions = fraction[axis];
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) {
      const double at = place(n), inside = std::min(at > 0 ? at : 0.0, lastCentre);  // not a number: the first cell
      const std::int32_t below = static_cast<std::int32_t>(inside);
      lowers[n] = below < lastLower ? below : lastLower;
      fractions[n] = static_cast<float>(inside - lowers[n]);
      note(n, at);
    }
  }
  template <class Place>
  void set(int axis, int count, int cells, const Place& place) {
    set(axis, count, cells, place, [](int, double) {});
  }
  void set(int n, const CellShares& share) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis][n] = share[axis].lower;
      fraction[axis][n] = share[axis].fraction;
    }
  }
  /// Of the n-th point's lower neighbours along y and z.
  std::int32_t rowOf(int n, const BandedRows& rows) const { return rows(lower[1][n], lower[2][n]); }
  CellShares operator[](int n) const {
    return {{{lower[0][n], fraction[0][n]}, {lower[1][n], fraction[1][n]}, {lower[2][n], fraction[2][n]}}};
  }
};

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

/// Adds points, sorted by their rows' numbers, to the cells, layer after layer. The sums are made in the points' order.
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
  BandedRows rows_;
};

}  // namespace brisance
