#include "base/row_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace brisance {
namespace {

TEST(RowLines, VisitEveryPlaceOfARowAndNoOther) {
  for (int count = 0; count <= 50; ++count) {
    std::vector<int> visits(count, 0);
    forLines(
        count, [](std::int64_t) {}, [&](std::int64_t i) { ++visits.at(i); });
    for (int i = 0; i < count; ++i) {
      EXPECT_GE(visits[i], 1) << i << " of " << count;
      EXPECT_LE(visits[i], count % lineFloats ? 2 : 1) << i << " of " << count;
    }
  }
}

TEST(RowLines, AskForEachLineBeforeItIsVisited) {
  std::int64_t asked = -1;
  forLines(
      40, [&](std::int64_t first) { asked = first; },
      [&](std::int64_t i) {
        EXPECT_GE(i, asked);
        EXPECT_LT(i, asked + lineFloats);
      });
  EXPECT_EQ(asked, 40 - lineFloats);
}

TEST(RowLines, SelectIsTheConditionalOperatorToTheBit) {
  EXPECT_EQ(select(true, 1.5f, 2.5f), 1.5f);
  EXPECT_EQ(select(false, 1.5f, 2.5f), 2.5f);
  EXPECT_TRUE(std::signbit(select(true, -0.0f, 0.0f)));
  EXPECT_EQ(select(false, NAN, 3.0f), 3.0f);  // what is not chosen leaves no trace
}

}  // namespace
}  // namespace brisance
