// Loops that are cut in their middle.
#include "base/cancellation.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/parallel.h"
#include "base/progress.h"

namespace brisance {
namespace {

TEST(Cancellation, EndsALoopBeforeAllOfItIsDone) {
  Cancellation cancellation;
  const CancellableWork work(&cancellation);
  constexpr std::int64_t count = 100000;
  std::atomic<std::int64_t> done = 0;
  EXPECT_THROW(parallelFor(0, count, 1,
                           [&](std::int64_t first, std::int64_t last) {
                             for (std::int64_t n = first; n < last; ++n)
                               throwIfCancelled(), ++done, cancellation.request();
                           }),
               Interrupted);
  EXPECT_GT(done, 0);
  EXPECT_LE(done, threadCount());
}

TEST(Cancellation, IsOfTheWorkThatItWasGivenTo) {
  Cancellation cancellation;
  cancellation.request();
  EXPECT_NO_THROW(throwIfCancelled());
  {
    const CancellableWork work(&cancellation);
    EXPECT_THROW(throwIfCancelled(), Interrupted);
    const CancellableWork undisturbed(nullptr);
    EXPECT_NO_THROW(throwIfCancelled());
  }
  EXPECT_FALSE(isCancelled());
}

/// What a loop inside another has passed it has done, also while an exception ends the other.
TEST(ParallelFor, ALoopInsideAnotherIsWholeOrThrows) {
  for (int round = 0; round < 50; ++round) {
    Cancellation cancellation;
    const CancellableWork work(&cancellation);
    std::atomic<bool> isWhole = true;
    const auto inner = [&](std::int64_t first, std::int64_t) {
      std::vector<int> written(5000, 0);
      parallelFor(0, std::ssize(written), 1, [&](std::int64_t from, std::int64_t to) {
        std::fill(written.begin() + from, written.begin() + to, 1);
        if (first == 20 && from > 2500) cancellation.request();
      });
      if (std::accumulate(written.begin(), written.end(), 0) != std::ssize(written)) isWhole = false;
    };
    EXPECT_THROW(parallelFor(0, 64, 1, inner), Interrupted);
    EXPECT_TRUE(isWhole);
  }
}

}  // namespace
}  // namespace brisance
