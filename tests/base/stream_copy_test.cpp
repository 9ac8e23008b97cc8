#include "base/stream_copy.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "base/vector_path.h"

namespace brisance {
namespace {

constexpr int room = 2000;

/// What becomes of numbers below zero when `stream(to, count)` acts from a place on.
template <class Stream>
std::vector<float> after(int first, const Stream& stream) {
  std::vector<float> numbers(room, -1);
  stream(numbers.data() + first);
  endStreaming();
  return numbers;
}

TEST(StreamCopy, WritesWhatItIsToldFromAnyPlaceOnAndNothingElse) {
  std::vector<float> from(room);
  std::iota(from.begin(), from.end(), 0.f);
  const VectorPath before = vectorPath();
  for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(path);
    for (const int first : {0, 1, 5, 15, 16, 31})
      for (const int count : {0, 1, 7, 16, 17, 300, 1000}) {
        const auto copied = after(first, [&](float* to) { streamCopy(to, from.data() + 3, count); });
        const auto cleared = after(first, [&](float* to) { streamZeros(to, count); });
        for (int n = 0; n < room; ++n) {
          const bool written = n >= first && n < first + count;
          ASSERT_EQ(copied[n], written ? from[3 + n - first] : -1) << first << " " << count << " " << n;
          ASSERT_EQ(cleared[n], written ? 0 : -1) << first << " " << count << " " << n;
        }
      }
  }
  forceVectorPath(before);
}

}  // namespace
}  // namespace brisance
