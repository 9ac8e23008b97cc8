// Stable counting sort on several threads: the same order for any number of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned.h"
#include "base/parallel.h"

namespace brisance {

/// Items in order of their bins, within a bin in the order in which they came. Its memory is used again.
template <class Item>
struct Binned {
  AlignedVector<Item> items;
  std::vector<std::uint32_t> start;  ///< first item of each bin, and the end of the last

  std::span<const Item> bin(std::int64_t number) const {
    return {items.data() + start[number], items.data() + start[number + 1]};
  }

  AlignedVector<Item> grouped;             ///< in order of groups of neighbouring bins
  std::vector<std::int32_t> binOf;         ///< of what comes n-th
  std::vector<std::int32_t> groupedBinOf;  ///< of the grouped items
  std::vector<std::uint32_t> next;         ///< per block of items and group: the place of the next item
  std::vector<std::uint32_t> groupStart;
};

constexpr int sortRun = 256;  ///< items that are made at once

namespace detail {
/// Few enough that their counts stay small beside the items; depends on the items' number alone.
struct SortBlocks {
  static constexpr std::int64_t smallest = 1 << 14, most = 16;
  std::int64_t number, size;
  explicit SortBlocks(std::int64_t items)
      : number(std::clamp<std::int64_t>(items / smallest, 1, most)), size((items + number - 1) / number) {}

  /// Calls visit(block, first, end) for runs of at most sortRun items, a block's on one thread and in their order.
  template <class Visit>
  void forRuns(std::int64_t items, const Visit& visit) const {
    parallelFor(0, number, 1, [&](std::int64_t firstBlock, std::int64_t lastBlock) {
      for (std::int64_t block = firstBlock; block < lastBlock; ++block) {
        const std::int64_t end = std::min(items, (block + 1) * size);
        for (std::int64_t n = block * size; n < end; n += sortRun) visit(block, n, std::min(end, n + sortRun));
      }
    });
  }
};

/// Groups of 2^shift neighbouring bins: so few that the caches hold a line of each while items are spread over them,
/// so many that they hold a group while it is sorted.
struct BinGroups {
  static constexpr std::int64_t most = 512;
  int shift = 0;
  std::int64_t number;
  explicit BinGroups(std::int64_t bins) {
    while ((bins - 1) >> shift >= most) ++shift;
    number = ((bins - 1) >> shift) + 1;
  }
};

/// From counts per block and group to the place of each block's first item in each group.
inline void placeBlocks(std::int64_t blocks, std::int64_t groups, std::vector<std::uint32_t>& next,
                        std::vector<std::uint32_t>& start) {
  start.resize(static_cast<std::size_t>(groups) + 1);
  std::uint32_t at = 0;
  for (std::int64_t group = 0; group < groups; ++group) {
    start[group] = at;
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::uint32_t count = next[block * groups + group];
      next[block * groups + group] = at;
      at += count;
    }
  }
  start[groups] = at;
}

/// Sorts the grouped items [first, end) by their bins, `bins` of them from firstBin on.
template <class Item>
void sortGroup(Binned<Item>& sorted, std::uint32_t first, std::uint32_t end, std::int64_t firstBin, std::int64_t bins) {
  std::vector<std::uint32_t> next(bins, 0);
  for (std::uint32_t n = first; n < end; ++n) ++next[sorted.groupedBinOf[n] - firstBin];
  std::uint32_t at = first;
  for (std::int64_t bin = 0; bin < bins; ++bin) {
    sorted.start[firstBin + bin] = at;
    at += next[bin];
    next[bin] = sorted.start[firstBin + bin];
  }
  for (std::uint32_t n = first; n < end; ++n)
    sorted.items[next[sorted.groupedBinOf[n] - firstBin]++] = sorted.grouped[n];
}
}  // namespace detail

/// Sorts items n = 0 .. count - 1, fewer than 2^32: binsOf(first, end, bins) tells the bins of a run of them, each
/// below `bins` or -1 to leave it out; makeItems(first, end, items) makes them, with whatever for those left out. Both
/// are called from several threads, once for each run. The items are spread over groups of bins and each group is
/// sorted apart: spread over all bins at once, each would come to a line of memory of its own.
template <class Item, class BinsOf, class MakeItems>
void sortIntoBins(std::int64_t count, std::int64_t bins, const BinsOf& binsOf, const MakeItems& makeItems,
                  Binned<Item>& result) {
  const detail::SortBlocks blocks(count);
  const detail::BinGroups groups(bins);
  result.binOf.resize(static_cast<std::size_t>(count));
  result.next.assign(static_cast<std::size_t>(blocks.number * groups.number), 0);
  blocks.forRuns(count, [&](std::int64_t block, std::int64_t first, std::int64_t end) {
    std::uint32_t* counts = result.next.data() + block * groups.number;
    binsOf(first, end, result.binOf.data() + first);
    for (std::int64_t n = first; n < end; ++n)
      if (result.binOf[n] >= 0) ++counts[result.binOf[n] >> groups.shift];
  });
  detail::placeBlocks(blocks.number, groups.number, result.next, result.groupStart);
  const std::uint32_t kept = result.groupStart.back();
  result.grouped.resize(kept);
  result.groupedBinOf.resize(kept);
  blocks.forRuns(count, [&](std::int64_t block, std::int64_t first, std::int64_t end) {
    std::uint32_t* next = result.next.data() + block * groups.number;
    std::array<Item, sortRun> items;
    makeItems(first, end, items.data());
    for (std::int64_t n = first; n < end; ++n) {
      const std::int32_t bin = result.binOf[n];
      if (bin < 0) continue;
      const std::uint32_t at = next[bin >> groups.shift]++;
      result.grouped[at] = items[n - first];
      result.groupedBinOf[at] = bin;
    }
  });
  result.items.resize(kept);
  result.start.resize(static_cast<std::size_t>(bins) + 1);
  result.start[bins] = kept;
  parallelFor(0, groups.number, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t group = first; group < last; ++group) {
      const std::int64_t firstBin = group << groups.shift;
      detail::sortGroup(result, result.groupStart[group], result.groupStart[group + 1], firstBin,
                        std::min(bins - firstBin, std::int64_t{1} << groups.shift));
    }
  });
}

}  // namespace brisance
