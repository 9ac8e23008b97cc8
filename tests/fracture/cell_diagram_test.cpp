#include "fracture/cell_diagram.h"

#include <gtest/gtest.h>

namespace brisance {
namespace {

std::vector<WeightedSeed> randomSeeds(int count, std::int64_t heaviest, std::uint64_t seed) {
  const Random random(seed, Stream::test);
  const auto draw = [&](int n) {
    return static_cast<std::int64_t>(random.below(1 << seedBits, n)) - (std::int64_t{1} << (seedBits - 1));
  };
  std::vector<WeightedSeed> seeds;
  for (int n = 0; n < count; ++n) {
    const std::int64_t weight = heaviest > 0 ? static_cast<std::int64_t>(random.below(heaviest, 100000 + n)) : 0;
    seeds.push_back({{draw(3 * n), draw(3 * n + 1), draw(3 * n + 2)}, weight});
  }
  return seeds;
}

TEST(CellDiagram, TheWalkEndsInTheCellOfLeastPowerDistance) {
  for (const std::int64_t heaviest : {std::int64_t{0}, std::int64_t{1} << 30, std::int64_t{1} << 33}) {
    const CellDiagram diagram(randomSeeds(300, heaviest, 5));
    const Random random(6, Stream::test);
    std::uint32_t cell = noCell;
    for (int n = 0; n < 1000; ++n) {
      Vec3l vertex;
      for (int axis = 0; axis < 3; ++axis)
        vertex[axis] =
            static_cast<std::int64_t>(random.below(std::uint64_t{1} << (seedBits + vertexBits), 3 * n + axis)) -
            (std::int64_t{1} << (seedBits + vertexBits - 1));
      cell = diagram.cellOf(vertex, cell);
      for (std::uint32_t other = 0; other < diagram.cellCount(); ++other)
        EXPECT_GE(diagram.power(other, vertex), diagram.power(cell, vertex));
    }
  }
}

TEST(CellDiagram, FourCellsMeetWhereNoOtherSeedIsNearer) {
  const CellDiagram diagram(randomSeeds(200, std::int64_t{1} << 30, 8));
  const auto power = [&](std::uint32_t seed, const Vec3d& p) {
    const Vec3d d = p - Vec3d(diagram.seeds()[seed].place);
    return dot(d, d) - static_cast<double>(diagram.seeds()[seed].weight);
  };
  int met = 0;
  for (const Tetrahedron& t : diagram.tetrahedra()) {
    const Vec3d p = diagram.meetingPoint(t);
    const double here = power(t.seeds[0], p), rounding = 1e-9 * (std::abs(here) + 1e12);
    for (const std::uint32_t seed : t.seeds) EXPECT_NEAR(power(seed, p), here, rounding);
    for (std::uint32_t other = 0; other < diagram.cellCount(); ++other) EXPECT_GE(power(other, p), here - rounding);
    ++met;
  }
  EXPECT_GT(met, 200);
}

TEST(CellDiagram, AHeavySeedHidesItsNeighbours) {
  std::vector<WeightedSeed> seeds = randomSeeds(50, 0, 9);
  seeds.push_back({{1, 2, 3}, std::int64_t{1} << 36});
  const CellDiagram diagram(seeds);
  int hidden = 0;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) hidden += diagram.neighbours(cell).empty();
  EXPECT_GT(hidden, 25);
  EXPECT_EQ(diagram.cellOf({0, 0, 0}, noCell), 50u);
}

TEST(CellDiagram, SeedsOnALatticeCoincide) {
  std::vector<WeightedSeed> seeds;
  seeds.reserve(27);
  for (int i = 0; i < 27; ++i) seeds.push_back({{1000 * (i % 3), 1000 * (i / 3 % 3), 1000 * (i / 9)}, 0});
  EXPECT_THROW(CellDiagram{seeds}, Coincidence);
}

}  // namespace
}  // namespace brisance
