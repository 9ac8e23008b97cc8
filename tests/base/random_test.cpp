#include "base/random.h"

#include <gtest/gtest.h>

#include <vector>

namespace brisance {
namespace {

constexpr std::uint64_t count = 1000000;
// Five deviations of a mean over `count` draws: one seed in two million fails, and the seeds are fixed.
const double fiveDeviations = 5 / std::sqrt(static_cast<double>(count));

TEST(Random, UniformHasTheMeanAndVarianceOfTheUnitInterval) {
  const Random random(1, Stream::test);
  double sum = 0, squares = 0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double u = random.uniform(n);
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u - 0.5;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / count, 0, fiveDeviations * std::sqrt(1.0 / 12));
  EXPECT_NEAR(squares / count, 1.0 / 12, fiveDeviations * std::sqrt(1.0 / 180));  // the variance of (u - 1/2)^2
}

TEST(Random, NormalHasTheFirstFourMoments) {
  const Random random(2, Stream::test);
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double x = random.normal(n);
    m1 += x, m2 += x * x, m3 += x * x * x, m4 += x * x * x * x;
  }
  // Variances of x, x^2, x^3, x^4 for a normal x: 1, 2, 15, 96.
  EXPECT_NEAR(m1 / count, 0, fiveDeviations);
  EXPECT_NEAR(m2 / count, 1, fiveDeviations * std::sqrt(2.0));
  EXPECT_NEAR(m3 / count, 0, fiveDeviations * std::sqrt(15.0));
  EXPECT_NEAR(m4 / count, 3, fiveDeviations * std::sqrt(96.0));
}

TEST(Random, SphereIsCoveredEvenly) {
  const Random random(3, Stream::test);
  Vec3d sum;
  Vec3d squares;
  for (std::uint64_t n = 0; n < count; ++n) {
    const Vec3d p = random.onSphere(n);
    ASSERT_NEAR(length(p), 1, 1e-14);
    sum += p;
    squares += p * p;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / count, 0, fiveDeviations * std::sqrt(1.0 / 3));
    EXPECT_NEAR(squares[axis] / count, 1.0 / 3, fiveDeviations * std::sqrt(4.0 / 45));  // the variance of x^2
  }
}

TEST(Random, BelowGivesEveryNumberEquallyOften) {
  const Random random(4, Stream::test);
  std::vector<double> hits(7);
  for (std::uint64_t n = 0; n < count; ++n) ++hits.at(random.below(7, n));
  for (const double h : hits) EXPECT_NEAR(h / count, 1.0 / 7, fiveDeviations * std::sqrt(6.0 / 49));
}

/// Correlation of two sequences of uniform draws; its deviation is 1 / sqrt(count).
double correlation(const Random& a, const Random& b, std::uint64_t shift) {
  double sum = 0;
  for (std::uint64_t n = 0; n < count; ++n) sum += (a.uniform(n) - 0.5) * (b.uniform(n + shift) - 0.5);
  return 12 * sum / count;
}

TEST(Random, StreamsSeedsAndNeighbouringDrawsAreIndependent) {
  const Random random(5, Stream::test);
  EXPECT_NEAR(correlation(random, Random(5, Stream::emission), 0), 0, fiveDeviations);
  EXPECT_NEAR(correlation(random, Random(6, Stream::test), 0), 0, fiveDeviations);
  EXPECT_NEAR(correlation(random, random, 1), 0, fiveDeviations);
  EXPECT_NEAR(correlation(random, random, 3), 0, fiveDeviations);
}

TEST(Random, EveryBitIsSetHalfOfTheTime) {
  const Random random(0, Stream::panePoints);
  std::vector<double> set(64);
  for (std::uint64_t n = 0; n < count; ++n)
    for (int bit = 0; bit < 64; ++bit) set[bit] += static_cast<double>(random.bits(n) >> bit & 1);
  for (const double s : set) EXPECT_NEAR(s / count, 0.5, fiveDeviations / 2);
}

TEST(Random, DrawsAreAddressedNotConsumed) {
  const Random a(7, Stream::test), b(7, Stream::test);
  const double later = a.uniform(99);
  EXPECT_EQ(b.uniform(0), a.uniform(0));
  EXPECT_EQ(b.uniform(99), later);
}

}  // namespace
}  // namespace brisance
