// Rows of one layer of cells, of which parts are filled.
#pragma once

#include <algorithm>
#include <vector>

#include "base/aligned.h"

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

/// Rows of cells, the channels of a cell side by side, zero but for the span of each that is filled. A row has room for
/// `width` numbers and starts at a vector.
class LayerRows {
 public:
  LayerRows(int rows, int channels, int width)
      : channels_(channels),
        width_((width + vectorFloats - 1) / vectorFloats * vectorFloats),
        values_(static_cast<std::size_t>(rows) * width_, 0.f),
        filled_(rows) {}

  /// The first row gets the number `number`.
  void numberFrom(int number) { first_ = number; }
  float* operator[](int row) { return values_.data() + static_cast<std::int64_t>(row - first_) * width_; }
  const CellSpan& filled(int row) const { return filled_[row - first_]; }
  /// To be told of whatever is written to a row.
  void hasFilled(int row, const CellSpan& span) { filled_[row - first_].include(span); }
  /// What is filled of any of the rows [first, end).
  CellSpan filled(int first, int end) const {
    CellSpan all;
    for (int row = first; row < end; ++row) all.include(filled(row));
    return all;
  }
  void clear() {
    for (std::size_t n = 0; n < filled_.size(); ++n) {
      float* row = values_.data() + static_cast<std::int64_t>(n) * width_;
      if (!filled_[n].empty()) std::fill(row + channels_ * filled_[n].first, row + channels_ * filled_[n].end, 0.f);
      filled_[n] = {};
    }
  }
  /// To be told where rows [first, end) were set to zero.
  void isClear(int first, int end) {
    for (int row = first; row < end; ++row) filled_[row - first_] = {};
  }

 private:
  static constexpr int vectorFloats = 16;
  int channels_, width_, first_ = 0;
  AlignedVector<float> values_;
  std::vector<CellSpan> filled_;
};

}  // namespace brisance
