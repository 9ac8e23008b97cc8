// Rows of numbers that sweeps over the gas make as they go.
#pragma once

#include <algorithm>

#include "base/aligned.h"
#include "base/row_lines.h"
#include "grid/grid3.h"

namespace brisance {

/// So many rows, each with a line of the cache more at both ends than `length` numbers need; they start at one.
class Rooms {
 public:
  Rooms(int length, int count)
      : width_((length + lineFloats - 1) / lineFloats * lineFloats + 2 * lineFloats),
        floats_(width_ * static_cast<std::size_t>(count), 0.0f) {}
  void clear() { std::fill(floats_.begin(), floats_.end(), 0.0f); }
  float* operator[](int n) { return floats_.data() + n * width_; }

 private:
  std::int64_t width_;
  AlignedVector<float> floats_;
};

template <class T>
void sizeAs(Grid3<T>& grid, const Grid3<T>& model) {
  if (!(grid.size == model.size)) grid = model;
}

}  // namespace brisance
