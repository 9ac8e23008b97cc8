#include "fluid/line_elimination.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/vector_path.h"

namespace brisance {
namespace {

constexpr AxisEnds allEnds[] = {AxisEnds::walls, AxisEnds::open, AxisEnds::wallThenOpen, AxisEnds::openThenWall,
                                AxisEnds::periodic};
constexpr int sizes[] = {1, 2, 3, 7, 64, 129};
constexpr int count = 48;  // lines: three vectors
constexpr float scale = 0.25f;

using Samples = AlignedVector<float>;

/// From hardly any to the largest that two axes make; line 0's is `first`.
Samples manyLambdas(float first) {
  Samples lambda(count);
  for (int l = 0; l < count; ++l) lambda[l] = static_cast<float>(8 * std::pow(10.0, -6.0 * l / (count - 1)));
  lambda[0] = first;
  return lambda;
}

Samples randomLines(int n) {
  Samples lines(static_cast<std::size_t>(n) * count);
  const Random random(5, Stream::test);
  for (std::size_t at = 0; at < lines.size(); ++at) lines[at] = static_cast<float>(random.normal(at));
  return lines;
}

Samples solved(AxisEnds ends, int n, Samples lines, const Samples& lambda, bool undetermined,
               const std::uint8_t* present = nullptr) {
  LineElimination::Scratch scratch;
  LineElimination(ends, n).solve({lines.data(), count, present}, {lambda.data(), scale, count, undetermined}, scratch);
  return lines;
}

/// Sample k of line l, which may be one beyond an end.
double sampleOf(const Samples& x, AxisEnds ends, int n, int k, int l) {
  if (ends == AxisEnds::periodic) k = (k + n) % n;
  if (k >= 0 && k < n) return x[k * count + l];
  const bool openHere = ends == AxisEnds::open || ends == (k < 0 ? AxisEnds::openThenWall : AxisEnds::wallThenOpen);
  return (openHere ? -1 : 1) * double(x[(k < 0 ? 0 : n - 1) * count + l]);
}

double imageOf(const Samples& x, AxisEnds ends, int n, int k, int l, double lambda) {
  const double here = x[k * count + l];
  return lambda * here + ((here - sampleOf(x, ends, n, k - 1, l)) - (sampleOf(x, ends, n, k + 1, l) - here));
}

double largestOf(const Samples& x, int n, int l) {
  double largest = 0;
  for (int k = 0; k < n; ++k) largest = std::max(largest, std::abs(double(x[k * count + l])));
  return largest;
}

constexpr double rounding = 1e-6;  // a few roundings of numbers of about 1

TEST(LineElimination, WhatItFindsObeysTheEquationsUpToTheRoundingOfItself) {
  for (const AxisEnds ends : allEnds)
    for (const int n : sizes) {
      const Samples b = randomLines(n), lambda = manyLambdas(3e-7f), x = solved(ends, n, b, lambda, false);
      for (int l = 0; l < count; ++l)
        for (int k = 0; k < n; ++k)
          ASSERT_NEAR(imageOf(x, ends, n, k, l, lambda[l]), scale * b[k * count + l],
                      rounding * (1 + largestOf(x, n, l)))
              << "ends " << static_cast<int>(ends) << " n " << n << " k " << k << " line " << l;
    }
}

TEST(LineElimination, OfAnUndeterminedLineTheMeanIsIgnored) {
  for (const AxisEnds ends : {AxisEnds::walls, AxisEnds::periodic})
    for (const int n : sizes) {
      const Samples b = randomLines(n), lambda = manyLambdas(0), x = solved(ends, n, b, lambda, true);
      double mean = 0, meanX = 0;
      for (int k = 0; k < n; ++k) mean += scale * double(b[k * count]) / n, meanX += double(x[k * count]) / n;
      const double bound = rounding * (1 + largestOf(x, n, 0));
      EXPECT_NEAR(meanX, 0, bound);
      for (int k = 0; k < n; ++k)
        ASSERT_NEAR(imageOf(x, ends, n, k, 0, 0), scale * b[k * count] - mean, bound) << n << " " << k;
    }
}

TEST(LineElimination, AbsentSamplesAreZeroAndStayUntouched) {
  constexpr float untouched = -7;
  for (const AxisEnds ends : allEnds)
    for (const int n : {7, 64}) {
      const bool undetermined = ends == AxisEnds::walls || ends == AxisEnds::periodic;
      Samples full = randomLines(n), sparse = full;
      std::vector<std::uint8_t> present(n);
      for (int k = 0; k < n; ++k) present[k] = k % 3 == 1;
      for (int at = 0; at < n * count; ++at)
        if (!present[at / count]) full[at] = 0, sparse[at] = untouched;
      const Samples lambda = manyLambdas(0), a = solved(ends, n, full, lambda, undetermined),
                    b = solved(ends, n, sparse, lambda, undetermined, present.data());
      for (int at = 0; at < n * count; ++at) EXPECT_EQ(b[at], present[at / count] ? a[at] : untouched);
    }
}

TEST(LineElimination, EveryVectorWidthGivesTheSameBits) {
  for (const AxisEnds ends : allEnds)
    for (const int n : {7, 64}) {
      std::vector<Samples> results;
      for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
        forceVectorPath(path);
        results.push_back(solved(ends, n, randomLines(n), manyLambdas(1e-4f), false));
      }
      EXPECT_EQ(results[0], results[1]);
      EXPECT_EQ(results[0], results[2]);
    }
}

}  // namespace
}  // namespace brisance
