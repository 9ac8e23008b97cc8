#include "base/counting_sort.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace brisance {
namespace {

struct Item {
  std::uint32_t number = 0, bin = 0;
  friend bool operator==(const Item&, const Item&) = default;
};

Binned<Item> sorted(std::int64_t count, std::uint32_t bins, std::uint64_t seed) {
  const Random random(seed, Stream::test);
  Binned<Item> result;
  const auto item = [&](std::int64_t n) {
    const auto number = static_cast<std::uint64_t>(n);
    return Item{static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(random.below(bins + 1, number))};
  };
  const auto make = [&](std::int64_t first, std::int64_t end, std::int32_t* binOf, Item* items) {
    for (std::int64_t n = first; n < end; ++n) {
      items[n - first] = item(n);
      binOf[n - first] = item(n).bin < bins ? static_cast<std::int32_t>(item(n).bin) : -1;
    }
  };
  sortIntoBins(count, bins, make, result);
  return result;
}

TEST(CountingSort, KeepsTheOrderWithinABinAndLeavesOutWhatHasNone) {
  for (const std::int64_t count : {0, 1, 1000, 100000})
    for (const std::uint32_t bins : {1U, 37U, 512U, 513U, 5000U}) {  // up to several bins in a group of them
      const Binned<Item> result = sorted(count, bins, 1);
      std::size_t seen = 0;
      for (std::uint32_t bin = 0; bin < bins; ++bin) {
        std::int64_t previous = -1;
        for (const Item& item : result.bin(bin)) {
          ASSERT_EQ(item.bin, bin);
          ASSERT_GT(item.number, previous);
          previous = item.number;
          ++seen;
        }
      }
      EXPECT_EQ(seen, result.items.size());
      EXPECT_NEAR(static_cast<double>(seen), static_cast<double>(count) * bins / (bins + 1),
                  5 * std::sqrt(static_cast<double>(count) / (bins + 1)));
    }
}

TEST(CountingSort, DoesNotDependOnTheNumberOfThreads) {
  const Binned<Item> expected = sorted(70000, 5000, 2);
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(sorted(70000, 5000, 2).items, expected.items);
  }
}

}  // namespace
}  // namespace brisance
