// Stable counting sort on several threads: the same order for any number of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace brisance {

/// Items in order of their bins, within a bin in the order in which they came. Its memory is used again.
template <class Item>
struct Binned {
  std::vector<Item> items;
  std::vector<std::uint32_t> start;  ///< first item of each bin, and the end of the last

  std::span<const Item> bin(std::int64_t number) const {
    return {items.data() + start[number], items.data() + start[number + 1]};
  }

  std::vector<Item> unsorted;
  std::vector<std::int32_t> binOf;
  std::vector<std::uint32_t> next;  ///< per block of items and bin
};

namespace detail {
/// Few enough that their counts stay small beside the items; depends on the items' number alone.
struct SortBlocks {
  static constexpr std::int64_t smallest = 1 << 14, most = 16;
  std::int64_t number, size;
  explicit SortBlocks(std::int64_t items)
      : number(std::clamp<std::int64_t>(items / smallest, 1, most)), size((items + number - 1) / number) {}
};

/// From counts per block and bin to the place of each block's first item in each bin.
inline void placeBlocks(std::int64_t blocks, std::int64_t bins, std::vector<std::uint32_t>& next,
                        std::vector<std::uint32_t>& start) {
  start.resize(static_cast<std::size_t>(bins) + 1);
  std::uint32_t at = 0;
  for (std::int64_t bin = 0; bin < bins; ++bin) {
    start[bin] = at;
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::uint32_t count = next[block * bins + bin];
      next[block * bins + bin] = at;
      at += count;
    }
  }
  start[bins] = at;
}
}  // namespace detail

/// Sorts what `make(n, item)` fills for n = 0 .. count - 1; it returns the item's bin, or -1 to leave it out. It is
/// called from several threads, once for each n. Fewer than 2^32 items.
template <class Item, class Make>
void sortIntoBins(std::int64_t count, std::int64_t bins, const Make& make, Binned<Item>& result) {
  const detail::SortBlocks blocks(count);
  result.unsorted.resize(static_cast<std::size_t>(count));
  result.binOf.resize(static_cast<std::size_t>(count));
  result.next.assign(static_cast<std::size_t>(blocks.number * bins), 0);
  const auto forItemsOfBlocks = [&](const auto& visit) {
    parallelFor(0, blocks.number, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last; ++block)
        for (std::int64_t n = block * blocks.size; n < std::min(count, (block + 1) * blocks.size); ++n)
          visit(result.next.data() + block * bins, n);
    });
  };
  forItemsOfBlocks([&](std::uint32_t* counts, std::int64_t n) {
    const std::int64_t bin = make(n, result.unsorted[n]);
    result.binOf[n] = static_cast<std::int32_t>(bin);
    if (bin >= 0) ++counts[bin];
  });
  detail::placeBlocks(blocks.number, bins, result.next, result.start);
  result.items.resize(result.start.back());
  forItemsOfBlocks([&](std::uint32_t* next, std::int64_t n) {
    if (result.binOf[n] >= 0) result.items[next[result.binOf[n]]++] = result.unsorted[n];
  });
}

}  // namespace brisance
