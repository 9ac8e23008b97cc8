// Where in the box a step can change temperature, soot or flame: around cells that differ from the ambient gas, and
// where fuel burns. Elsewhere a step leaves every bit as it is and need not go.
#pragma once

#include <algorithm>

#include "fluid/fluid_state.h"

namespace brisance {

/// Cells [first, end) of a row.
struct RowSpan {
  int first = 0, end = 0;
  bool empty() const { return first >= end; }
  void join(const RowSpan& other) {
    if (other.empty()) return;
    if (empty()) *this = other;
    first = std::min(first, other.first);
    end = std::max(end, other.end);
  }
};

class ChangingSpans {
 public:
  /// Reads all scalars and sources once.
  void find(const FluidState& gas, const FluidSettings& settings);
  /// Of a row of cells, in whole lines of the cache: what touches a cell that differs, across any face, or is fed.
  RowSpan at(int j, int k) const;

 private:
  const RowSpan& differing(int j, int k) const { return differing_[std::int64_t{cells_.y} * k + j]; }
  RowSpan wholeLines(const RowSpan& span) const;

  Vec3i cells_;
  bool around_[3];  ///< periodic axes
  std::vector<RowSpan> differing_, fed_;
};

}  // namespace brisance
