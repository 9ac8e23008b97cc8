#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/random.h"

namespace brisance {
namespace {

/// Numbers of both signs over many magnitudes, so that any other order of the sum gives other bits.
double term(std::int64_t n) {
  const Random random(1, Stream::test);
  const auto index = static_cast<std::uint64_t>(n);
  return random.normal(index) * portableExp(20 * random.uniform(index + 1000000));
}

double sumWithThreads(int threads) {
  const ThreadLimit limit(threads);
  return parallelSum(100000, 64, [](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (std::int64_t n = first; n < last; ++n) sum += term(n);
    return sum;
  });
}

TEST(ParallelSum, HasTheSameBitsForAnyNumberOfThreads) {
  const double one = sumWithThreads(1);
  EXPECT_NE(one, 0);
  for (const int threads : {2, 3, 8, 0}) EXPECT_EQ(sumWithThreads(threads), one) << threads;
}

TEST(ParallelSum, CountsEveryElementOnce) {
  for (const std::int64_t count : {0, 1, 63, 64, 65, 1000})
    EXPECT_EQ(
        parallelSum(count, 64, [](std::int64_t first, std::int64_t last) { return static_cast<double>(last - first); }),
        static_cast<double>(count));
}

TEST(ParallelMax, FindsTheLargestWhereverItIs) {
  for (const std::int64_t place : {0, 500, 999}) {
    const auto block = [&](std::int64_t first, std::int64_t last) {
      return first <= place && place < last ? 3.5 : 1.0;
    };
    EXPECT_EQ(parallelMax(1000, 7, block), 3.5);
  }
  EXPECT_EQ(parallelMax(0, 7, [](std::int64_t, std::int64_t) { return 1.0; }), 0);
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
  std::vector<std::atomic<int>> visits(10000);
  parallelFor(0, 10000, 16, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) ++visits[n];
  });
  for (const auto& v : visits) ASSERT_EQ(v, 1);
}

TEST(ParallelFor, PassesOnWhatItsBodyThrows) {
  const auto body = [](std::int64_t first, std::int64_t) {
    if (first >= 0) throw std::runtime_error("from a thread");
  };
  EXPECT_THROW(parallelFor(0, 1000, 1, body), std::runtime_error);
}

TEST(ThreadLimit, HoldsWhileItLivesOnly) {
  const int before = threadCount();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(threadCount(), 1);
  }
  EXPECT_EQ(threadCount(), before);
}

}  // namespace
}  // namespace brisance
