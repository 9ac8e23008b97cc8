#include <gtest/gtest.h>

#include "base/random.h"
#include "grid/brick_source.h"
#include "grid/interpolate.h"

namespace brisance {
namespace {

Grid3<float> noise(const Vec3i& size, std::uint64_t seed) {
  const Random random(seed, Stream::test);
  Grid3<float> grid(size, {-1, 2, 0.5}, 0.25);
  for (std::int64_t n = 0; n < grid.count(); ++n)
    grid.values[n] = static_cast<float>(random.normal(static_cast<std::uint64_t>(n)));
  return grid;
}

TEST(Grid3, IndexAndStridesAgree) {
  const Grid3<float> grid({4, 5, 6}, {}, 1);
  EXPECT_EQ(grid.index(0, 0, 0), 0);
  EXPECT_EQ(grid.index(3, 4, 5), grid.count() - 1);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(grid.index(1 + (axis == 0), 2 + (axis == 1), 3 + (axis == 2)) - grid.index(1, 2, 3), grid.stride(axis));
  EXPECT_TRUE(grid.contains(3, 4, 5));
  EXPECT_FALSE(grid.contains(-1, 0, 0));
  EXPECT_FALSE(grid.contains(0, 5, 0));
}

// Three blends of values below 5, each rounded to float.
constexpr double blendRounding = 3 * 5 * 1.2e-7;

TEST(Interpolate, GivesEachSampleAtItsPlace) {
  const Grid3<float> grid = noise({5, 4, 3}, 1);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i) EXPECT_NEAR(interpolate(grid, grid.position(i, j, k)), grid(i, j, k), blendRounding);
}

TEST(Interpolate, ReproducesAnAffineField) {
  Grid3<float> grid({6, 6, 6}, {-1, 2, 0.5}, 0.25);
  const auto field = [](const Vec3d& p) { return 1 + 2 * p.x - 3 * p.y + 0.5 * p.z; };
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) grid(i, j, k) = static_cast<float>(field(grid.position(i, j, k)));
  const Random random(1, Stream::test);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const Vec3d p =
        grid.origin + Vec3d(random.uniform(3 * n), random.uniform(3 * n + 1), random.uniform(3 * n + 2)) * 1.25;
    // Values reach 13; each of seven blends rounds to float.
    EXPECT_NEAR(interpolate(grid, p), field(p), 13 * 8 * 6e-8);
  }
}

TEST(Interpolate, HoldsTheNearestSampleOutside) {
  const Grid3<float> grid = noise({3, 3, 3}, 2);
  EXPECT_NEAR(interpolate(grid, grid.origin - Vec3d(5, 5, 5)), grid(0, 0, 0), blendRounding);
  EXPECT_NEAR(interpolate(grid, grid.origin + Vec3d(5, 5, 5)), grid(2, 2, 2), blendRounding);
}

TEST(Interpolate, WorksWhereAGridIsOneSampleThick) {
  const Grid3<float> grid = noise({3, 1, 1}, 3);
  EXPECT_NEAR(interpolate(grid, grid.position(2, 0, 0)), grid(2, 0, 0), blendRounding);
  EXPECT_NEAR(interpolate(grid, grid.position(1, 7, -7)), grid(1, 0, 0), blendRounding);
}

TEST(MacVelocity, ComponentsLieOnTheFacesOfTheirAxis) {
  const MacVelocity velocity({4, 5, 6}, {1, 2, 3}, 0.5);
  EXPECT_EQ(velocity.cells(), Vec3i(4, 5, 6));
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& component = velocity.component(axis);
    const Vec3d corner(1, 2, 3);
    for (int other = 0; other < 3; ++other) {
      EXPECT_EQ(component.origin[other], corner[other] + (other == axis ? 0 : 0.25));
      EXPECT_EQ(component.size[other], velocity.cells()[other] + (other == axis ? 1 : 0));
    }
  }
}

TEST(MacVelocity, UniformFlowIsUniformEverywhere) {
  MacVelocity velocity({4, 4, 4}, {0, 0, 0}, 1);
  for (int axis = 0; axis < 3; ++axis)
    for (float& value : velocity.component(axis).values) value = static_cast<float>(axis + 1);
  EXPECT_EQ(interpolate(velocity, Vec3d(1.3, 3.99, 0.01)), Vec3d(1, 2, 3));
}

TEST(SparseGrid, KeepsTheBricksThatDifferInOrderOfTheirPlace) {
  Grid3<float> dense({20, 9, 17}, {1, 2, 3}, 0.5, 300.f);
  dense(19, 0, 0) = 1;
  dense(0, 8, 0) = 2;
  dense(3, 0, 16) = 3;
  const SparseGrid<float> sparse = makeSparse(dense, 300.f);
  ASSERT_EQ(sparse.bricks.size(), 3u);
  EXPECT_EQ(sparse.bricks[0].corner, Vec3i(16, 0, 0));
  EXPECT_EQ(sparse.bricks[1].corner, Vec3i(0, 8, 0));
  EXPECT_EQ(sparse.bricks[2].corner, Vec3i(0, 0, 16));
  EXPECT_EQ(sparse.bricks[0].values[3], 1);
  EXPECT_EQ(sparse.bricks[1].values[0], 2);
  EXPECT_EQ(sparse.bricks[2].values[3], 3);
  EXPECT_EQ(sparse.bricks[0].values[4], 300);  // beyond the grid
  EXPECT_EQ(sparse.origin, dense.origin);
  EXPECT_EQ(sparse.size, dense.size);
}

TEST(SparseGrid, OfOneValueHoldsNothing) {
  EXPECT_TRUE(makeSparse(Grid3<float>({9, 9, 9}, {}, 1, 5.f), 5.f).bricks.empty());
}

}  // namespace
}  // namespace brisance
