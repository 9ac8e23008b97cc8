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

  AlignedVector<Item> grouped;             ///< block after block of what came, each in order of groups of bins
  std::vector<std::int32_t> groupedBinOf;  ///< of the grouped items
  std::vector<std::uint32_t> pieceStart;   ///< per block and group: the first grouped item, and the block's end
  std::vector<std::uint32_t> groupStart;   ///< first item of each group, and the end of the last
};

constexpr int sortRun = 256;  ///< items that are made at once

namespace detail {
/// Few enough items that the caches hold a block of them while it is sorted; depends on the items' number alone.
struct SortBlocks {
  static constexpr std::int64_t size = 1 << 14;
  std::int64_t items, number;
  explicit SortBlocks(std::int64_t items_) : items(items_), number((items + size - 1) / size) {}

  /// Calls visit(first, end) for runs of at most sortRun items of a block, in their order.
  template <class Visit>
  void forRuns(std::int64_t block, const Visit& visit) const {
    const std::int64_t end = std::min(items, (block + 1) * size);
    for (std::int64_t n = block * size; n < end; n += sortRun) visit(n, std::min(end, n + sortRun));
  }
};

/// Groups of 2^shift neighbouring bins: so few that a block has some items for each, so many that the caches hold a
/// group while it is sorted.
struct BinGroups {
  static constexpr std::int64_t most = 512;
  int shift = 0;
  std::int64_t number;
  explicit BinGroups(std::int64_t bins) {
    while ((bins - 1) >> shift >= most) ++shift;
    number = ((bins - 1) >> shift) + 1;
  }
};

/// Asks for the memory some lines after this place, which is written in turn with that of other places: a store to a
/// line that is not in the caches holds up all stores after it.
template <class T>
void fetchToWrite(const T* place, std::size_t lines) {
  constexpr std::size_t line = 64;
  constexpr int toWrite = 1;
  __builtin_prefetch(reinterpret_cast<const char*>(place) + lines * line, toWrite);
}

/// Groups the items of a block, within a group in their order.
template <class Item, class BinsOf, class MakeItems>
void groupBlock(const SortBlocks& blocks, std::int64_t block, const BinGroups& groups, const BinsOf& binsOf,
                const MakeItems& makeItems, Binned<Item>& result) {
  const std::int64_t begin = block * SortBlocks::size;
  std::array<std::int32_t, SortBlocks::size> binOf;
  std::array<std::uint32_t, BinGroups::most> next{};
  blocks.forRuns(block, [&](std::int64_t first, std::int64_t end) {
    binsOf(first, end, &binOf[first - begin]);
    for (std::int64_t n = first - begin; n < end - begin; ++n)
      if (binOf[n] >= 0) ++next[binOf[n] >> groups.shift];
  });
  constexpr std::size_t linesAhead = 2;
  const auto fetchPlaces = [&](std::uint32_t place, std::size_t lines) {
    fetchToWrite(result.grouped.data() + place, lines);
    fetchToWrite(result.groupedBinOf.data() + place, lines / 2);
  };
  std::uint32_t* start = &result.pieceStart[block * (groups.number + 1)];
  std::uint32_t at = static_cast<std::uint32_t>(begin);
  for (std::int64_t group = 0; group < groups.number; ++group) {
    start[group] = at;
    at += next[group];
    next[group] = start[group];
    for (std::size_t lines = 0; lines < linesAhead; ++lines) fetchPlaces(start[group], lines);
  }
  start[groups.number] = at;
  blocks.forRuns(block, [&](std::int64_t first, std::int64_t end) {
    std::array<Item, sortRun> items;
    makeItems(first, end, items.data());
    for (std::int64_t n = first; n < end; ++n) {
      const std::int32_t bin = binOf[n - begin];
      if (bin < 0) continue;
      const std::uint32_t to = next[bin >> groups.shift]++;
      fetchPlaces(to, linesAhead);
      result.grouped[to] = items[n - first];
      result.groupedBinOf[to] = bin;
    }
  });
}

/// Where the groups lie that the blocks' pieces make.
template <class Item>
void placeGroups(std::int64_t blocks, std::int64_t groups, Binned<Item>& result) {
  result.groupStart.assign(static_cast<std::size_t>(groups) + 1, 0);
  for (std::int64_t block = 0; block < blocks; ++block) {
    const std::uint32_t* start = &result.pieceStart[block * (groups + 1)];
    for (std::int64_t group = 0; group < groups; ++group)
      result.groupStart[group + 1] += start[group + 1] - start[group];
  }
  for (std::int64_t group = 0; group < groups; ++group) result.groupStart[group + 1] += result.groupStart[group];
}

/// Sorts the items of a group, which lie in a piece of each block, by their bins, `bins` of them from firstBin on.
template <class Item>
void sortGroup(Binned<Item>& sorted, std::int64_t blocks, std::int64_t group, std::int64_t firstBin,
               std::int64_t bins) {
  const std::int64_t groups = static_cast<std::int64_t>(sorted.groupStart.size()) - 1;
  const auto prefetch = [&](std::uint32_t first, std::uint32_t end) {  // the caches find the rest from the start
    constexpr std::size_t line = 64, most = 8 * line;
    const char* items = reinterpret_cast<const char*>(sorted.grouped.data() + first);
    __builtin_prefetch(sorted.groupedBinOf.data() + first);
    for (std::size_t byte = 0; byte < std::min(most, (end - first) * sizeof(Item)); byte += line)
      __builtin_prefetch(items + byte);
  };
  const auto forItems = [&](const auto& visit) {
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::uint32_t* piece = &sorted.pieceStart[block * (groups + 1) + group];
      if (block + 1 < blocks) prefetch(piece[groups + 1], piece[groups + 2]);
      for (std::uint32_t n = piece[0]; n < piece[1]; ++n) visit(n, sorted.groupedBinOf[n] - firstBin);
    }
  };
  std::vector<std::uint32_t> next(bins, 0);
  std::uint32_t at = sorted.groupStart[group];
  const Item* place = sorted.items.data() + at;
  forItems([&](std::uint32_t, std::int64_t bin) {
    ++next[bin];
    fetchToWrite(place++, 0);
  });
  for (std::int64_t bin = 0; bin < bins; ++bin) {
    sorted.start[firstBin + bin] = at;
    at += next[bin];
    next[bin] = sorted.start[firstBin + bin];
  }
  forItems([&](std::uint32_t n, std::int64_t bin) { sorted.items[next[bin]++] = sorted.grouped[n]; });
}
}  // namespace detail

/// Sorts items n = 0 .. count - 1, fewer than 2^32: binsOf(first, end, bins) tells the bins of a run of them, each
/// below `bins` or -1 to leave it out; makeItems(first, end, items) makes them, with whatever for those left out. Both
/// are called from several threads, once for each run. Blocks of items are sorted into groups of bins, and each group,
/// gathered from all blocks, into its bins: items spread over all bins at once would each come to a line of memory of
/// its own.
template <class Item, class BinsOf, class MakeItems>
void sortIntoBins(std::int64_t count, std::int64_t bins, const BinsOf& binsOf, const MakeItems& makeItems,
                  Binned<Item>& result) {
  const detail::SortBlocks blocks(count);
  const detail::BinGroups groups(bins);
  result.pieceStart.resize(static_cast<std::size_t>(blocks.number * (groups.number + 1)));
  result.grouped.resize(static_cast<std::size_t>(count));
  result.groupedBinOf.resize(static_cast<std::size_t>(count));
  parallelFor(0, blocks.number, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t block = first; block < last; ++block)
      detail::groupBlock(blocks, block, groups, binsOf, makeItems, result);
  });
  detail::placeGroups(blocks.number, groups.number, result);
  const std::uint32_t kept = result.groupStart.back();
  result.items.resize(kept);
  result.start.resize(static_cast<std::size_t>(bins) + 1);
  result.start[bins] = kept;
  parallelFor(0, groups.number, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t group = first; group < last; ++group) {
      const std::int64_t firstBin = group << groups.shift;
      detail::sortGroup(result, blocks.number, group, firstBin,
                        std::min(bins - firstBin, std::int64_t{1} << groups.shift));
    }
  });
}

}  // namespace brisance
