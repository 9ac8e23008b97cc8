// Where the fast pressure solvers keep one float per cell.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Memory that starts at a cache line; large pieces start at a huge page and ask the kernel for such pages, since a
/// sweep along z touches another page with every sample.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t line = 64, hugePage = std::size_t{2} << 20;
    const std::size_t bytes = count * sizeof(T), unit = bytes < 4 * hugePage ? line : hugePage;
    const std::size_t rounded = (bytes + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, rounded);
    if (!memory) throw std::bad_alloc();
    if (unit == hugePage) madvise(memory, rounded, MADV_HUGEPAGE);  // advice: without it all works, slower
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};
using AlignedFloats = std::vector<float, CacheLineAllocator<float>>;

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
