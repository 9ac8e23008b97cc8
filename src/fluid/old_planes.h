// Planes of scalars at both sides of where slabs of the box meet, as they were before a sweep that changes them in
// place: one slab needs the other's when that may be done.
#pragma once

#include <array>

#include "fluid/changing_spans.h"
#include "fluid/scalar_row.h"

namespace brisance {

/// Planes of cells [first, end).
struct Slab {
  int first, end;
};

/// How the box is shared out.
class Slabs {
 public:
  explicit Slabs(int planes) : planes_(planes) {}
  int count() const { return (planes_ + planesEach - 1) / planesEach; }
  Slab operator[](int n) const { return {n * planesEach, std::min(planes_, (n + 1) * planesEach)}; }

 private:
  static constexpr int planesEach = 16;
  int planes_;
};

class OldPlanes {
 public:
  /// Copies what a step reads there, of the rows that change.
  void keep(const FluidState& gas, const Slabs& slabs, const ChangingSpans& spans, bool periodic);
  /// A row of the plane below a slab, or above it; null where the box ends there.
  const float* below(int slab, int field, int j) const { return at(slab, field, 0, j); }
  const float* above(int slab, int field, int j) const { return at(slab + 1, field, 1, j); }

 private:
  const float* at(int meeting, int field, int side, int j) const {
    if (!periodic_ && (meeting == 0 || meeting == meetings_)) return nullptr;
    return &floats_[index(meeting % meetings_, field, side, j)];
  }
  std::size_t index(int meeting, int field, int side, int j) const {
    return ((std::size_t(meeting) * scalarFields + field) * 2 + side) * rows_ * width_ + std::size_t(j) * width_;
  }
  int meetings_ = 0, rows_ = 0, width_ = 0;
  bool periodic_ = false;
  AlignedVector<float> floats_;
};

}  // namespace brisance
