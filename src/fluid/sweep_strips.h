// The order in which sweeps go over the box: strips of rows, plane after plane, so that the planes around a row are
// still in the processor's own cache when the next one needs them.
#pragma once

#include <algorithm>

#include "base/math.h"

namespace brisance {

/// Rows of cells [firstRow, endRow) of planes [firstPlane, endPlane).
struct SweepStrip {
  int firstRow, endRow, firstPlane, endPlane;
};

class SweepStrips {
 public:
  explicit SweepStrips(const Vec3i& cells)
      : cells_(cells), rows_(std::clamp(floatsOfRows / std::max(1, cells.x), 4, std::max(4, cells.y))) {}
  int rowsPerStrip() const { return rows_; }
  int count() const { return across() * ((cells_.z + planesPerStrip - 1) / planesPerStrip); }
  SweepStrip operator[](int n) const {
    const int row = n % across() * rows_, plane = n / across() * planesPerStrip;
    return {row, std::min(cells_.y, row + rows_), plane, std::min(cells_.z, plane + planesPerStrip)};
  }

 private:
  static constexpr int floatsOfRows = 8192;  // of a plane of a strip: a dozen of them fill half of the cache
  static constexpr int planesPerStrip = 32;  // of which the first costs more
  int across() const { return (cells_.y + rows_ - 1) / rows_; }
  Vec3i cells_;
  int rows_;
};

}  // namespace brisance
