// Memory that starts where a cache line does, for loops over wide vectors.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <new>
#include <vector>

namespace brisance {

/// Memory that starts at a cache line; large pieces start at a huge page and ask the kernel for such pages, since a
/// sweep along z touches another page with every sample, and a walk over a graph with nearly every node.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t line = 64, hugePage = std::size_t{2} << 20;
    const std::size_t bytes = count * sizeof(T), unit = bytes < hugePage ? line : hugePage;
    const std::size_t rounded = (bytes + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, rounded);
    if (!memory) throw std::bad_alloc();
    if (unit == hugePage) madvise(memory, rounded, MADV_HUGEPAGE);  // advice: without it all works, slower
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace brisance
