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
  sortIntoBins(
      count, bins,
      [&](std::int64_t n, Item& item) -> std::int64_t {
        const auto number = static_cast<std::uint64_t>(n);
        item = {static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(random.below(bins + 1, number))};
        return item.bin < bins ? static_cast<std::int64_t>(item.bin) : -1;
      },
      result);
  return result;
}

TEST(CountingSort, KeepsTheOrderWithinABinAndLeavesOutWhatHasNone) {
  for (const std::int64_t count : {0, 1, 1000, 100000}) {
    const Binned<Item> result = sorted(count, 37, 1);
    std::size_t seen = 0;
    for (std::uint32_t bin = 0; bin < 37; ++bin) {
      std::int64_t previous = -1;
      for (const Item& item : result.bin(bin)) {
        ASSERT_EQ(item.bin, bin);
        ASSERT_GT(item.number, previous);
        previous = item.number;
        ++seen;
      }
    }
    EXPECT_EQ(seen, result.items.size());
    EXPECT_NEAR(static_cast<double>(seen), static_cast<double>(count) * 37 / 38,
                5 * std::sqrt(static_cast<double>(count) / 38));
  }
}

TEST(CountingSort, DoesNotDependOnTheNumberOfThreads) {
  const Binned<Item> expected = sorted(70000, 500, 2);
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(sorted(70000, 500, 2).items, expected.items);
  }
}

}  // namespace
}  // namespace brisance
