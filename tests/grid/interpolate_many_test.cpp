#include "grid/interpolate_many.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/vector_path.h"
#include "grid/interpolate.h"

namespace brisance {
namespace {

Grid3<float> noise(const Vec3i& size) {
  const Random random(1, Stream::test);
  Grid3<float> grid(size, {-1, 2, 0.5}, 0.25);
  for (std::int64_t n = 0; n < grid.count(); ++n)
    grid.values[n] = static_cast<float>(random.normal(static_cast<std::uint64_t>(n)));
  return grid;
}

/// In the grid, on its samples and beyond it.
std::vector<Vec3d> placesIn(const Grid3<float>& grid, int count) {
  const Random random(2, Stream::test);
  std::vector<Vec3d> places{grid.origin, grid.position(grid.size.x - 1, grid.size.y - 1, grid.size.z - 1)};
  while (std::ssize(places) < count) {
    const std::uint64_t n = places.size();
    const Vec3d share(random.uniform(3 * n), random.uniform(3 * n + 1), random.uniform(3 * n + 2));
    places.push_back(grid.origin + (share * 1.4 - Vec3d(.2, .2, .2)) * Vec3d(grid.size) * grid.cellSize);
  }
  return places;
}

TEST(InterpolateMany, IsWhatInterpolatingOneByOneGives) {
  for (const Vec3i size : {Vec3i(9, 7, 5), Vec3i(2, 2, 2), Vec3i(1, 4, 3), Vec3i(1, 1, 1)})
    for (const int count : {0, 1, 127, 128, 300}) {
      const Grid3<float> grid = noise(size);
      const std::vector<Vec3d> places = placesIn(grid, count);
      std::vector<float> values(places.size());
      interpolateMany(grid, places, values.data());
      // Shares are known to 6e-8; seven differences of values of a few units follow.
      for (std::size_t n = 0; n < places.size(); ++n) ASSERT_NEAR(values[n], interpolate(grid, places[n]), 5e-6);
    }
}

TEST(InterpolateMany, IsExactForALinearField) {
  Grid3<float> grid({8, 8, 8}, {0, 0, 0}, 0.5);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) grid(i, j, k) = static_cast<float>(i + 10 * j - 3 * k);
  const Random random(3, Stream::test);
  std::vector<Vec3d> places;
  places.reserve(200);
  for (std::uint64_t n = 0; n < 200; ++n)
    places.emplace_back(3.5 * random.uniform(3 * n), 3.5 * random.uniform(3 * n + 1), 3.5 * random.uniform(3 * n + 2));
  std::vector<float> values(places.size());
  interpolateMany(grid, places, values.data());
  for (std::size_t n = 0; n < places.size(); ++n)
    ASSERT_NEAR(values[n], (places[n].x + 10 * places[n].y - 3 * places[n].z) / 0.5, 1e-5 * 10);
}

TEST(InterpolateMany, GivesAVelocityTheBitsOfItsComponents) {
  const Random random(4, Stream::test);
  for (const Vec3i cells : {Vec3i(9, 7, 5), Vec3i(1, 4, 3)}) {
    MacVelocity velocity(cells, {-1, 2, 0.5}, 0.25);
    for (int axis = 0; axis < 3; ++axis)
      for (float& sample : velocity.component(axis).values)
        sample = static_cast<float>(random.normal(&sample - &velocity.component(axis).values[0] + 1000 * axis));
    const std::vector<Vec3d> places = placesIn(velocity.u, PlaceBlock::most);
    PlaceBlock block;
    for (int n = 0; n < PlaceBlock::most; ++n)
      for (int axis = 0; axis < 3; ++axis) block.along[axis][n] = places[n][axis];
    WindBlock wind;
    interpolateMany(velocity, block, PlaceBlock::most, wind);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> expected(places.size());
      interpolateMany(velocity.component(axis), places, expected.data());
      EXPECT_EQ(std::vector<float>(wind.along[axis], wind.along[axis] + PlaceBlock::most), expected);
    }
  }
}

TEST(InterpolateMany, HasTheSameBitsWithAnyVectors) {
  const Grid3<float> grid = noise({12, 9, 15});
  const std::vector<Vec3d> places = placesIn(grid, 1000);
  std::vector<float> expected(places.size());
  interpolateMany(grid, places, expected.data());
  const VectorPath before = vectorPath();
  for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(path);
    std::vector<float> values(places.size());
    interpolateMany(grid, places, values.data());
    EXPECT_EQ(values, expected);
  }
  forceVectorPath(before);
}

}  // namespace
}  // namespace brisance
