#include "base/report.h"

#include <gtest/gtest.h>

namespace brisance {
namespace {

TEST(Balance, ClosesWhenAllThatCameInIsAccountedFor) {
  EXPECT_EQ((Balance{.in = 10, .gained = 6, .out = 3, .lost = 1}.error()), 0);
  EXPECT_EQ((Balance{.in = -10, .gained = -6, .out = -3, .lost = -1}.error()), 0);
  EXPECT_EQ(Balance{}.error(), 0);
}

TEST(Balance, ErrorIsWhatIsMissingRelativeToTheLargestTerm) {
  EXPECT_DOUBLE_EQ((Balance{.in = 10, .gained = 6, .out = 3, .lost = 0}.error()), 0.1);
  EXPECT_DOUBLE_EQ((Balance{.in = 0, .gained = 5, .out = 0, .lost = 0}.error()), 1);
}

TEST(Balance, StepsAddUpTermByTerm) {
  Balance sum{.in = 1, .gained = 2, .out = 3, .lost = 4};
  sum += Balance{.in = 10, .gained = 20, .out = 30, .lost = 40};
  EXPECT_EQ(sum.in, 11);
  EXPECT_EQ(sum.gained, 22);
  EXPECT_EQ(sum.out, 33);
  EXPECT_EQ(sum.lost, 44);
}

}  // namespace
}  // namespace brisance
