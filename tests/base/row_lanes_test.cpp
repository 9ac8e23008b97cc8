#include "base/row_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "base/vector_path.h"

namespace brisance {
namespace {

std::vector<float> numbers(int count) {
  std::vector<float> row(count);
  const Random random(3, Stream::test);
  for (int i = 0; i < count; ++i) row[i] = static_cast<float>(2 * random.uniform(i) - 1);
  return row;
}

/// The lanes of the sum of squares and of the largest magnitude, of two rows alike.
std::array<Lanes, 2> lanesOf(const std::vector<float>& row) {
  std::array<Lanes, 2> lanes{};
  runWithVectors([&]<int floats>() {
    for (int again = 0; again < 2; ++again)
      overLanes<floats>(std::ssize(row), lanes, [&]<int n>(std::int64_t i, auto& at) {
        using V = NamedVectors<n>;
        const typename V::Type number = V::at(&row[i]);
        typename V::Type magnitude;
        V::magnitude(number, magnitude);
        at[0] += number * number;
        at[1] = magnitude > at[1] ? magnitude : at[1];
      });
  });
  return lanes;
}

TEST(RowLanes, AddUpWhatTheRowsHoldWithTheSameBitsForAnyVectors) {
  for (const int count : {1, 4, 15, 16, 17, 40, 256}) {
    const std::vector<float> row = numbers(count);
    double sum = 0;
    float largest = 0;
    for (const float number : row) {
      sum += 2 * double(number) * number;
      largest = std::max(largest, std::abs(number));
    }
    std::array<Lanes, 2> first{};
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      forceVectorPath(path);
      std::array<Lanes, 2> lanes = lanesOf(row);
      if (path == VectorPath::plain) first = lanes;
      EXPECT_EQ(lanes, first) << count;
      LaneTotal total;
      total.add(lanes[0]);
      EXPECT_NEAR(total.take() / sum, 1, 1e-6);
      EXPECT_EQ(total.take(), 0);
      EXPECT_EQ(takeLargest(lanes[1]), largest);
      EXPECT_EQ(takeLargest(lanes[1]), 0);
    }
  }
  forceVectorPath(VectorPath::avx512);
}

}  // namespace
}  // namespace brisance
