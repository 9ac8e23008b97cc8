#include "grid/splat.h"

#include <gtest/gtest.h>

#include <set>

namespace brisance {
namespace {

TEST(BandedRows, GivesEachRowANumberOfItsOwnAndThoseOfALayerOfABandInTurn) {
  for (const int rowsPerLayer : {1, 3, 4, 5, 16, 30})
    for (const int layers : {1, 2, 7}) {
      const BandedRows number(rowsPerLayer, layers);
      std::set<std::int32_t> numbers;
      for (int k = 0; k < layers; ++k)
        for (int j = 0; j < rowsPerLayer; ++j) {
          numbers.insert(number(j, k));
          EXPECT_LT(number(j, k), number.count());
          if (j % 4 != 0) {
            EXPECT_EQ(number(j, k), number(j - 1, k) + 1);
          }
        }
      EXPECT_EQ(std::ssize(numbers), std::int64_t{rowsPerLayer} * layers);
      EXPECT_GE(*numbers.begin(), 0);
    }
}

}  // namespace
}  // namespace brisance
