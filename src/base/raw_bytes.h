// Numbers and bytes that are made in place: growing does not fill them first.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace brisance {

/// Leaves new values as the memory is: clearing what will be written anyway costs as much as a sweep.
template <class T, template <class> class Allocator = std::allocator>
struct Unset : Allocator<T> {
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): as allocators name it
    using other = Unset<U, Allocator>;
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

using RawBytes = std::vector<char, Unset<char>>;

}  // namespace brisance
