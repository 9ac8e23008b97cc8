#include "frame/finished_cells.h"

#include <gtest/gtest.h>

#include "base/aligned.h"
#include "base/random.h"
#include "base/stream_copy.h"
#include "base/vector_path.h"

namespace brisance {
namespace {

constexpr float untouched = -1, perVolume = 3;

/// Mass, none in every third cell, and mass times colour.
std::vector<float> randomSums(int cells) {
  const Random random(1, Stream::test);
  std::vector<float> sums(static_cast<std::size_t>(sumsPerCell) * (cells + cellsPerLine));
  for (std::size_t n = 0; n < sums.size(); ++n)
    sums[n] = n / sumsPerCell % 3 == 0 ? 0.f : static_cast<float>(random.uniform(n));
  return sums;
}

/// Cells [first, first + count) of memory that starts at a line are as they should be, and all others as they were.
void checkFinished(int first, int count) {
  const std::vector<float> sums = randomSums(count);
  const int room = first + count + cellsPerLine;
  AlignedVector<float> density(static_cast<std::size_t>(room), untouched), colour(density.size() * 3, untouched);
  fetchLastLines(density.data() + first + count, colour.data() + 3 * (first + count));
  finishCells(sums.data(), count, perVolume, density.data() + first, colour.data() + 3 * first);
  endStreaming();
  for (int n = 0; n < room; ++n) {
    const float* cell = sums.data() + sumsPerCell * (n - first);
    const bool inside = n >= first && n < first + count;
    ASSERT_EQ(density[n], inside ? cell[0] * perVolume : untouched) << n;
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(colour[3 * n + c], !inside ? untouched : cell[0] > 0 ? cell[1 + c] * (1 / cell[0]) : 0) << n;
  }
}

TEST(FinishedCells, AreDensityAndMeanColourWhereverTheyLieInALine) {
  const VectorPath before = vectorPath();
  for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(path);
    for (const int first : {0, 1, 4, 15})
      for (const int count : {1, 3, 15, 16, 17, 31, 33, 64, 255, mostFinishedCells}) checkFinished(first, count);
  }
  forceVectorPath(before);
}

}  // namespace
}  // namespace brisance
