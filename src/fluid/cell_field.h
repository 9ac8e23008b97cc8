// Where the fast pressure solvers keep one float per cell.
#pragma once

#include "base/aligned.h"
#include "base/math.h"

namespace brisance {

using AlignedFloats = AlignedVector<float>;

/// Rows along x start at cache lines. Around the box lies a layer of ghosts, which neighbouring rows and planes share:
/// all ghosts hold zero. The distance between planes is an odd number of cache lines, so that samples along z do not
/// fall into one set of the cache.
struct CellLayout {
  static constexpr int lanes = 16;  ///< floats in a cache line, and lines that a transform takes at a time

  Vec3i cells;
  std::int64_t row = 0;    ///< from (i, j, k) to (i, j + 1, k)
  std::int64_t plane = 0;  ///< from (i, j, k) to (i, j, k + 1)
  std::int64_t first = 0;  ///< place of cell (0, 0, 0)
  std::int64_t count = 0;  ///< of floats

  CellLayout() = default;
  explicit CellLayout(const Vec3i& cells_) : cells(cells_) {
    row = roundedRow() + lanes;
    plane = row * (cells.y + 1);
    if (plane / lanes % 2 == 0) plane += lanes;
    first = plane + row + lanes;
    count = first + plane * (cells.z + 1) + lanes;
  }
  /// Cells of a row, rounded up to whole cache lines; those beyond the box hold zero.
  int roundedRow() const { return (cells.x + lanes - 1) / lanes * lanes; }
  std::int64_t index(int i, int j, int k) const { return first + i + row * j + plane * k; }
  friend bool operator==(const CellLayout&, const CellLayout&) = default;
};

struct CellField {
  CellLayout layout;
  AlignedFloats values;

  CellField() = default;
  explicit CellField(const CellLayout& layout_) : layout(layout_), values(layout_.count, 0.0f) {}
  float* row(int j, int k) { return values.data() + layout.index(0, j, k); }
  const float* row(int j, int k) const { return values.data() + layout.index(0, j, k); }
  float& operator()(int i, int j, int k) { return values[layout.index(i, j, k)]; }
  float operator()(int i, int j, int k) const { return values[layout.index(i, j, k)]; }
};

}  // namespace brisance
