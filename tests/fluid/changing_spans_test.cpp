#include "fluid/changing_spans.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/row_lines.h"
#include "fluid/fluid_fixture.h"

namespace brisance {
namespace {
using namespace test;

constexpr float ambient = 300;

/// Ambient gas but for a few cells: hot ones, sooty ones, burning ones.
FluidState fewCells(const FluidSettings& s, std::uint64_t seed) {
  FluidState gas = gasIn(s);
  const Random random(seed, Stream::test);
  Grid3<float>* fields[] = {&gas.temperature, &gas.soot, &gas.flame, &gas.heatRate, &gas.burnRate};
  std::uint64_t drawn = 0;
  for (Grid3<float>* field : fields) {
    const auto place = [&](int size) { return static_cast<int>(random.uniform(drawn++) * size); };
    const int i = place(s.cells.x), j = place(s.cells.y), k = place(s.cells.z);
    (*field)(i, j, k) += 1e-3f;
  }
  return gas;
}

/// Whether a step could change a cell: it or a neighbour is not as the ambient gas, or it is fed.
bool canChange(const FluidState& gas, const FluidSettings& s, const Vec3i& cell) {
  const auto differs = [&](const Vec3i& at) {
    return gas.temperature(at.x, at.y, at.z) != ambient || gas.soot(at.x, at.y, at.z) != 0 ||
           gas.flame(at.x, at.y, at.z) != 0;
  };
  if (differs(cell) || gas.heatRate(cell.x, cell.y, cell.z) != 0 || gas.burnRate(cell.x, cell.y, cell.z) != 0)
    return true;
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      Vec3i at = cell;
      at[axis] += step;
      if (isPeriodic(s.faces, axis)) at[axis] = (at[axis] + s.cells[axis]) % s.cells[axis];
      if (at[axis] >= 0 && at[axis] < s.cells[axis] && differs(at)) return true;
    }
  return false;
}

TEST(ChangingSpans, HoldEveryCellThatAStepCanChangeAndNoRowWithoutOne) {
  std::uint64_t seed = 0;
  for (const FaceKind kind : {FaceKind::open, FaceKind::periodic})
    for (const int width : {3, 16, 21, 64, 150}) {
      FluidSettings s = box({width, 7, 6});
      s.faces = allFaces(kind);
      s.ambientTemperature = ambient;
      const FluidState gas = fewCells(s, seed++);
      ChangingSpans spans;
      spans.find(gas, s);
      for (int k = 0; k < s.cells.z; ++k)
        for (int j = 0; j < s.cells.y; ++j) {
          const RowSpan span = spans.at(j, k);
          bool any = false;
          for (int i = 0; i < width; ++i) {
            const bool can = canChange(gas, s, {i, j, k});
            any |= can;
            EXPECT_TRUE(!can || (i >= span.first && i < span.end)) << i << " " << j << " " << k << " of " << width;
          }
          EXPECT_EQ(any, !span.empty());
        }
    }
}

TEST(ChangingSpans, AreWholeLinesAndTheLastOneNeverAlone) {
  for (const int width : {16, 21, 50, 64, 150}) {
    FluidSettings s = box({width, 3, 3});
    s.ambientTemperature = ambient;
    for (int i = 0; i < width; ++i) {
      FluidState gas = gasIn(s);
      gas.temperature(i, 1, 1) = 400;
      ChangingSpans spans;
      spans.find(gas, s);
      const RowSpan span = spans.at(1, 1);
      EXPECT_EQ(span.first % lineFloats, 0);
      EXPECT_TRUE(span.end == width || (span.end % lineFloats == 0 && span.end <= width - lineFloats)) << span.end;
      EXPECT_TRUE(span.end < width || width % lineFloats == 0 || span.first <= std::max(0, width - lineFloats));
      EXPECT_LE(span.end - span.first, 4 * lineFloats);
    }
  }
}

TEST(ChangingSpans, TakeWhatIsNotANumberForAChange) {
  FluidSettings s = box({20, 3, 3});
  s.ambientTemperature = ambient;
  FluidState gas = gasIn(s);
  gas.soot(7, 1, 1) = NAN;
  ChangingSpans spans;
  spans.find(gas, s);
  EXPECT_FALSE(spans.at(1, 1).empty());
}

}  // namespace
}  // namespace brisance
