// Rows of cells near which a scalar is not everywhere the same: a scheme of a few passes leaves all others as they are.
#pragma once

#include <vector>

#include "fluid/fluid_settings.h"
#include "grid/grid3.h"

namespace brisance {

class BusyRows {
 public:
  static constexpr int farthest = 3;
  /// Every row.
  void take(const Vec3i& cells);
  /// Those near a sample that is not `usual`; every row if those are most.
  void find(const Grid3<float>& scalar, float usual, const Faces& faces);
  bool all() const { return all_; }
  /// Whether there is such a sample within so many rows of row (j, k), up to `farthest`.
  bool within(int rows, int j, int k) const { return all_ || near_[rows][index(j, k)] != 0; }

 private:
  std::size_t index(int j, int k) const { return static_cast<std::size_t>(cells_.y) * k + j; }
  void widen(int rows, const Faces& faces);
  Vec3i cells_;
  bool all_ = true;
  std::vector<std::uint8_t> near_[farthest + 1];
};

}  // namespace brisance
