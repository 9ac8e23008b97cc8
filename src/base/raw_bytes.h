// Bytes that are made in place: growing does not fill them first.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace brisance {

/// Leaves new values as the memory was.
template <class T>
struct NoFillAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = NoFillAllocator<U>;
  };
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
};

using RawBytes = std::vector<char, NoFillAllocator<char>>;

}  // namespace brisance
