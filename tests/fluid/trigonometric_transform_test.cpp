#include "fluid/trigonometric_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/cell_field.h"

namespace brisance {
namespace {

constexpr AxisEnds allEnds[] = {AxisEnds::walls, AxisEnds::open, AxisEnds::wallThenOpen, AxisEnds::openThenWall,
                                AxisEnds::periodic};
constexpr int sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 30, 49, 64, 100, 128, 144};
constexpr int lanes = LineTransform::lanes;

AlignedFloats randomLines(int n) {
  AlignedFloats lines(static_cast<std::size_t>(n) * lanes);
  const Random random(5, Stream::test);
  for (std::size_t at = 0; at < lines.size(); ++at) lines[at] = static_cast<float>(random.normal(at));
  return lines;
}

/// Transforms of n numbers of about 1, each rounded about log n times.
double roundingOf(int n) { return 1e-6 * std::sqrt(n) * std::log2(n + 1.0); }

TEST(LineTransform, GivesTheSumsOverEveryMode) {
  for (const AxisEnds ends : allEnds)
    for (const int n : sizes) {
      const LineTransform transform(ends, n);
      AlignedFloats in = randomLines(n), out(in.size()), work(transform.workSize());
      transform.forward({in.data(), lanes}, {out.data(), lanes}, work.data());
      for (const int lane : {0, 7, 15})
        for (int k = 0; k < n; ++k) {
          double sum = 0;
          for (int j = 0; j < n; ++j) sum += in[j * lanes + lane] * modeValue(ends, n, k, j);
          ASSERT_NEAR(out[k * lanes + lane], sum, roundingOf(n))
              << "ends " << static_cast<int>(ends) << " n " << n << " k " << k;
        }
    }
}

TEST(LineTransform, TheInverseGivesNTimesTheSamplesBack) {
  for (const AxisEnds ends : allEnds)
    for (const int n : sizes) {
      const LineTransform transform(ends, n);
      AlignedFloats in = randomLines(n), out = in, work(transform.workSize());
      transform.forward({out.data(), lanes}, {out.data(), lanes}, work.data());
      transform.inverse({out.data(), lanes}, {out.data(), lanes}, work.data());
      for (std::size_t at = 0; at < in.size(); ++at)
        ASSERT_NEAR(out[at] / static_cast<float>(n), in[at], 3e-6) << static_cast<int>(ends) << " " << n;
    }
}

/// A sample and its neighbour beyond the end of the axis, as the ends say.
double neighbour(AxisEnds ends, int n, int k, int j) {
  if (j >= 0 && j < n) return modeValue(ends, n, k, j);
  if (ends == AxisEnds::periodic) return modeValue(ends, n, k, (j + n) % n);
  const bool openHere =
      ends == AxisEnds::open || (j < 0 ? ends == AxisEnds::openThenWall : ends == AxisEnds::wallThenOpen);
  return (openHere ? -1 : 1) * modeValue(ends, n, k, j < 0 ? 0 : n - 1);
}

TEST(LineTransform, ModesAreTheEigenvectorsOfTheSecondDifference) {
  for (const AxisEnds ends : allEnds)
    for (const int n : {1, 2, 5, 12})
      for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j) {
          const double here = modeValue(ends, n, k, j);
          EXPECT_NEAR(2 * here - neighbour(ends, n, k, j - 1) - neighbour(ends, n, k, j + 1),
                      modeEigenvalue(ends, n, k) * here, 1e-12)
              << static_cast<int>(ends) << " n " << n << " k " << k << " j " << j;
        }
}

TEST(LineTransform, EveryVectorWidthGivesTheSameBits) {
  for (const AxisEnds ends : allEnds)
    for (const int n : {7, 30, 64, 120, 128}) {
      const LineTransform transform(ends, n);
      std::vector<AlignedFloats> results;
      for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
        forceVectorPath(path);
        AlignedFloats lines = randomLines(n), work(transform.workSize());
        transform.forward({lines.data(), lanes}, {lines.data(), lanes}, work.data());
        results.push_back(lines);
        transform.inverse({lines.data(), lanes}, {lines.data(), lanes}, work.data());
        results.back().insert(results.back().end(), lines.begin(), lines.end());
      }
      EXPECT_EQ(results[0], results[1]);
      EXPECT_EQ(results[0], results[2]);
    }
}

}  // namespace
}  // namespace brisance
