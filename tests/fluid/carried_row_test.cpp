#include "fluid/carried_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/sweep_strips.h"

namespace brisance {
namespace {

constexpr float weight = 0.75f, c = 0.1f;

/// A row of numbers in [-1, 1] with room for ghosts at both ends.
std::vector<float> numbers(int count, std::uint64_t seed) {
  std::vector<float> row(count + 2);
  const Random random(seed, Stream::test);
  for (std::size_t n = 0; n < row.size(); ++n) row[n] = static_cast<float>(2 * random.uniform(n) - 1);
  return row;
}

/// The samples around a row, and speeds at its faces.
struct Sample {
  explicit Sample(int n) : count(n) {}
  int count;
  std::vector<float> here = numbers(count, 1), back = numbers(count, 2), forth = numbers(count, 3),
                     down = numbers(count, 4), up = numbers(count, 5), u = numbers(count, 6), v = numbers(count, 7),
                     vAbove = numbers(count, 8), w = numbers(count, 9), wAbove = numbers(count, 10);

  /// (speed - weight |speed|) times a rise, or the sum: what a face gives the sample below it, or above.
  static float below(float speed, float rise) { return (speed - weight * std::abs(speed)) * rise; }
  static float above(float speed, float rise) { return (speed + weight * std::abs(speed)) * rise; }
  float expected(int i) const {
    const int at = i + 1;
    const float s = here[at];
    const float x = below(u[at + 1], here[at + 1] - s) + above(u[at], s - here[at - 1]),
                y = below(vAbove[at], forth[at] - s) + above(v[at], s - back[at]),
                z = below(wAbove[at], up[at] - s) + above(w[at], s - down[at]);
    return s - c * ((x + y) + z);
  }
  std::vector<float> carried() const {
    std::vector<float> result(count), alongY(count + 16), alongZ(count + 16);
    runWithVectors([&]<int floats>() {
      awaitRow<floats>({0, count, count}, FaceRow<1>{{&v[1]}, &back[1], &here[1]}, weight, alongY.data());
      awaitRow<floats>({0, count, count}, FaceRow<1>{{&w[1]}, &down[1], &here[1]}, weight, alongZ.data());
      const SamplesAbove samples[1] = {
          {&here[1], {&here[2], &forth[1], &up[1]}, {nullptr, alongY.data(), alongZ.data()}}};
      carryRow<floats>(
          {0, count, count}, SpeedsAbove<1>{{{&u[2]}, {&vAbove[1]}, {&wAbove[1]}}}, samples, weight, c,
          [](std::int64_t) {}, [&]<int n>(std::int64_t i, const auto& s) { NamedVectors<n>::at(&result[i]) = s[0]; });
    });
    return result;
  }
};

TEST(CarriedRow, HasTheBitsOfTheFormulaWithVectorsOfAnyWidthAndRowsOfAnyLength) {
  for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(path);
    for (int count = 1; count <= 50; ++count) {
      const Sample sample(count);
      const std::vector<float> carried = sample.carried();
      for (int i = 0; i < count; ++i) EXPECT_EQ(carried[i], sample.expected(i)) << i << " of " << count;
    }
  }
  forceVectorPath(VectorPath::avx512);
}

TEST(CarriedRow, WhatWaitsForTheRowAboveIsWhatItsOwnFacesWouldGiveIt) {
  const int count = 21;
  const Sample sample(count);
  std::vector<float> waiting(48), again(48), none(48);
  runWithVectors([&]<int floats>() {
    awaitRow<floats>({0, count, count}, FaceRow<1>{{&sample.vAbove[1]}, &sample.here[1], &sample.forth[1]}, weight,
                     again.data());
    const SamplesAbove samples[1] = {
        {&sample.here[1], {&sample.here[2], &sample.forth[1], &sample.up[1]}, {nullptr, waiting.data(), none.data()}}};
    carryRow<floats>(
        {0, count, count}, SpeedsAbove<1>{{{&sample.u[2]}, {&sample.vAbove[1]}, {&sample.wAbove[1]}}}, samples, weight,
        c, [](std::int64_t) {}, []<int n>(std::int64_t, const auto&) {});
  });
  EXPECT_EQ(waiting, again);
}

TEST(SweepStrips, HoldEveryRowOfEveryPlaneOnce) {
  for (const Vec3i cells : {Vec3i{1, 1, 1}, Vec3i{5, 3, 70}, Vec3i{256, 100, 65}, Vec3i{20000, 9, 2}}) {
    const SweepStrips strips(cells);
    std::set<std::pair<int, int>> seen;
    for (int n = 0; n < strips.count(); ++n) {
      const SweepStrip strip = strips[n];
      EXPECT_LE(strip.endRow - strip.firstRow, strips.rowsPerStrip());
      for (int k = strip.firstPlane; k < strip.endPlane; ++k)
        for (int j = strip.firstRow; j < strip.endRow; ++j) EXPECT_TRUE(seen.insert({j, k}).second);
    }
    EXPECT_EQ(seen.size(), std::size_t(cells.y) * cells.z);
    EXPECT_EQ(*seen.rbegin(), std::make_pair(cells.y - 1, cells.z - 1));
  }
}

TEST(RowLines, SelectIsTheConditionalOperatorToTheBit) {
  EXPECT_EQ(select(true, 1.5f, 2.5f), 1.5f);
  EXPECT_EQ(select(false, 1.5f, 2.5f), 2.5f);
  EXPECT_TRUE(std::signbit(select(true, -0.0f, 0.0f)));
  EXPECT_EQ(select(false, NAN, 3.0f), 3.0f);  // what is not chosen leaves no trace
}

}  // namespace
}  // namespace brisance
