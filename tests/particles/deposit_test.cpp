#include "particles/deposit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "particles/burning.h"

namespace brisance {
namespace {

constexpr double dt = 0.01;  // [s]

/// A box of 1 m a side.
Grid3<std::uint8_t> boxOf(int cells) {
  const double h = 1.0 / cells;
  return {{cells, cells, cells}, Vec3d(.5, .5, .5) * h, h, 0};
}

struct Fire {
  BurnSettings settings;
  ParticleSet particles;
  std::vector<double> burnt;

  void add(const Vec3d& place, double mass = 0.36e-3, bool ignited = true) {
    append(particles, {place, {}, mass, 300, ParticleKind::fuel, ignited});
  }
  Grid3<float> rateIn(const Grid3<std::uint8_t>& solid) {
    ParticleSet burning = particles;
    burn(burning, settings, dt, burnt);
    Grid3<float> rate(solid.size, solid.origin, solid.cellSize, 7.f);  // what was there before does not count
    DepositScratch scratch;
    depositBurnt(burning, burnt, settings, dt, solid, rate, scratch);
    return rate;
  }
};

double massOf(const Grid3<float>& rate) {
  double sum = 0;
  for (const float r : rate.values) sum += r;
  return sum * rate.cellSize * rate.cellSize * rate.cellSize * dt;
}

Fire scatteredFire(int count, std::uint64_t seed) {
  Fire fire;
  const Random random(seed, Stream::test);
  for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(count); ++n)
    fire.add({random.uniform(3 * n), random.uniform(3 * n + 1), random.uniform(3 * n + 2)});
  return fire;
}

// Every cell's rate passes some tens of roundings to single precision.
constexpr double rounding = 50 * 6e-8;

TEST(Deposit, FuelBurntTimesItsHeatIsTheHeatOnTheGrid) {
  for (const double radius : {0.01, 0.1, 0.3})
    for (const bool solids : {false, true}) {
      Grid3<std::uint8_t> solid = boxOf(16);
      if (solids)
        for (int n = 5; n < 9; ++n) solid(n, 8, 7) = 1;  // a solid takes no heat
      Fire fire;
      fire.settings.depositRadius = radius;
      for (int n = 0; n < 50; ++n) fire.add(Vec3d(.3 + .008 * n, .5, .45), fire.settings.burnRate, n % 2 == 0);
      const Grid3<float> rate = fire.rateIn(solid);
      EXPECT_NEAR(massOf(rate) / (25 * fire.settings.burnRate * dt), 1, rounding);
      for (std::int64_t n = 0; n < rate.count(); ++n) EXPECT_TRUE(!solid.values[n] || rate.values[n] == 0);
    }
}

TEST(Deposit, ParticlesAtAndBeyondTheBordersLeaveAllTheirHeatInside) {
  const Grid3<std::uint8_t> solid = boxOf(12);
  const double edges[] = {0, 1e-9, .03, .5, .97, 1 - 1e-9, 1, 1.01, -.01};
  for (const double x : edges)
    for (const double y : edges) {
      Fire fire;
      fire.settings.depositRadius = 0.2;
      fire.add({x, y, 1 - x});
      EXPECT_NEAR(massOf(fire.rateIn(solid)) / fire.burnt[0], 1, rounding) << x << " " << y;
    }
}

TEST(Deposit, WithoutFireThereIsNone) {
  Fire fire;
  for (const float rate : fire.rateIn(boxOf(8)).values) EXPECT_EQ(rate, 0);
  fire.add({.5, .5, .5}, 1, false);
  for (const float rate : fire.rateIn(boxOf(8)).values) EXPECT_EQ(rate, 0);
}

/// The definition, for one cell: shares of eight cells, then the kernel along each axis, cut off at the box's faces.
double exactRate(const Fire& fire, const Vec3i& cell, int cells) {
  const double h = 1.0 / cells, wanted = std::pow(fire.settings.depositRadius / h, 2) / 9 - 1.0 / 6;
  const auto weight = [](int t, double r) { return std::abs(t) < r ? std::pow(1 - t * t / (r * r), 3) : 0; };
  double radius = 1;
  for (double step = 8; step > 1e-12; step /= 2) {  // the radius whose discrete variance is the wanted one
    double sum = 0, squares = 0;
    for (int t = -20; t <= 20; ++t) {
      sum += weight(t, radius + step);
      squares += t * t * weight(t, radius + step);
    }
    if (squares / sum < wanted) radius += step;
  }
  const auto spread = [&](int from, int to) {
    double inside = 0;
    for (int other = 0; other < cells; ++other) inside += weight(other - from, radius);
    return weight(to - from, radius) / inside;
  };
  double rate = 0;
  for (std::size_t n = 0; n < fire.burnt.size(); ++n) {
    double share = fire.burnt[n] / (dt * h * h * h);
    for (int axis = 0; axis < 3; ++axis) {
      const double p = std::clamp(fire.particles.position[n][axis] / h - .5, 0.0, cells - 1.0);
      const int lower = std::min(static_cast<int>(p), cells - 2);
      share *= (1 - (p - lower)) * spread(lower, cell[axis]) + (p - lower) * spread(lower + 1, cell[axis]);
    }
    rate += share;
  }
  return rate;
}

TEST(Deposit, IsItsDefinitionCellByCell) {
  const int cells = 24;
  Fire fire = scatteredFire(100, 1);
  fire.settings.depositRadius = 0.12;
  const Grid3<float> rate = fire.rateIn(boxOf(cells));
  const Random random(2, Stream::test);
  double largest = 0;
  for (const float r : rate.values) largest = std::max(largest, static_cast<double>(r));
  for (std::uint64_t n = 0; n < 300; ++n) {
    const Vec3i cell(static_cast<int>(random.below(cells, 3 * n)), static_cast<int>(random.below(cells, 3 * n + 1)),
                     static_cast<int>(random.below(cells, 3 * n + 2)));
    const double exact = exactRate(fire, cell, cells);
    // The kernel's tail is a cube of a difference: its radius is known to 1e-12, the rest is rounding.
    ASSERT_NEAR(rate(cell.x, cell.y, cell.z), exact, exact * rounding + largest * 1e-9);
  }
}

/// Deviation along each axis of a deposit about the mean place of its particles.
Vec3d deviationOf(const Grid3<float>& rate) {
  Vec3d mean, squares;
  double sum = 0;
  for (int k = 0; k < rate.size.z; ++k)
    for (int j = 0; j < rate.size.y; ++j)
      for (int i = 0; i < rate.size.x; ++i) {
        const Vec3d p = rate.position(i, j, k);
        const double r = rate(i, j, k);
        mean += p * r;
        squares += p * p * r;
        sum += r;
      }
  mean = mean / sum;
  squares = squares / sum - mean * mean;
  return {std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
}

TEST(Deposit, HasTheSameSizeOnEveryGrid) {
  // Places at all distances from the cells' centres: the mean of f (1 - f) is then 1/6.
  const int perAxis = 6;
  for (const int cells : {12, 24, 32, 64}) {
    Fire fire;
    fire.settings.depositRadius = 0.12;
    Vec3d placed;
    for (int n = 0; n < perAxis * perAxis * perAxis; ++n) {
      const Vec3d offset(n % perAxis, n / perAxis % perAxis, n / (perAxis * perAxis));
      fire.add(Vec3d(.5, .5, .5) + (offset + Vec3d(.5, .5, .5)) / (perAxis * cells));
    }
    // Beside the kernel, the places themselves are spread over a cell: perAxis of them, a uniform comb.
    const double comb = (1.0 - 1.0 / (perAxis * perAxis)) / 12 / (cells * cells);
    // f (1 - f) of the comb's middles has the mean 1/6 + 1/(12 perAxis^2).
    const double sharing = 1.0 / (12 * perAxis * perAxis) / (cells * cells);
    const Vec3d deviation = deviationOf(fire.rateIn(boxOf(cells)));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(deviation[axis], std::sqrt(0.04 * 0.04 + comb + sharing), 0.04 * 2e-5) << cells;
  }
}

TEST(Deposit, CentreStaysWhereTheParticleIs) {
  Fire fire;
  fire.settings.depositRadius = 0.1;
  const Vec3d place(.513, .477, .5);
  fire.add(place);
  const Grid3<float> rate = fire.rateIn(boxOf(32));
  Vec3d mean;
  double sum = 0;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        mean += rate.position(i, j, k) * rate(i, j, k);
        sum += rate(i, j, k);
      }
  EXPECT_LT(length(mean / sum - place), 1e-6 / 32);
}

TEST(Deposit, MirroredParticlesGiveTheMirroredRate) {
  const int cells = 16;  // a power of two: mirrored places are exact
  for (int axis = 0; axis < 3; ++axis) {
    Fire fire, mirrored;
    fire.settings.depositRadius = mirrored.settings.depositRadius = 0.2;
    Grid3<std::uint8_t> solid = boxOf(cells), mirroredSolid = solid;
    const Random random(4, Stream::test);
    for (std::uint64_t n = 0; n < 40; ++n) {
      Vec3d p(random.uniform(3 * n), random.uniform(3 * n + 1), random.uniform(3 * n + 2));
      fire.add(p);
      p[axis] = 1 - p[axis];
      mirrored.add(p);
    }
    const auto mirror = [&](Vec3i cell) {
      cell[axis] = cells - 1 - cell[axis];
      return cell;
    };
    for (int n = 3; n < 9; ++n) {
      const Vec3i cell(n, 5, 6), image = mirror(cell);
      solid(cell.x, cell.y, cell.z) = mirroredSolid(image.x, image.y, image.z) = 1;
    }
    const Grid3<float> a = fire.rateIn(solid), b = mirrored.rateIn(mirroredSolid);
    const double largest = *std::max_element(a.values.begin(), a.values.end());
    for (int k = 0; k < cells; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
          const Vec3i image = mirror({i, j, k});
          // A share f is known to 6e-8 of itself, its complement to 6e-8 of one.
          ASSERT_NEAR(a(i, j, k), b(image.x, image.y, image.z), a(i, j, k) * 1e-5 + largest * 1e-6);
        }
  }
}

TEST(Deposit, IsTheSameBitsOnAnyNumberOfThreadsAndVectors) {
  Fire fire = scatteredFire(40000, 5);  // more than one block of the sort
  fire.settings.depositRadius = 0.15;
  Grid3<std::uint8_t> solid = boxOf(20);
  solid(7, 8, 9) = 1;
  const Grid3<float> expected = fire.rateIn(solid);
  const VectorPath before = vectorPath();
  for (const int threads : {1, 2, 5})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      EXPECT_EQ(fire.rateIn(solid), expected);
    }
  forceVectorPath(before);
}

TEST(Deposit, MovedSolidsAreSeenThoughMemoryIsUsedAgain) {
  Fire fire = scatteredFire(200, 6);
  fire.settings.depositRadius = 0.15;
  DepositScratch scratch;
  for (const int place : {4, 9, 4}) {
    Grid3<std::uint8_t> solid = boxOf(16);
    solid(place, 8, 8) = 1;
    const Grid3<float> expected = fire.rateIn(solid);
    Grid3<float> rate(solid.size, solid.origin, solid.cellSize);
    depositBurnt(fire.particles, fire.burnt, fire.settings, dt, solid, rate, scratch);
    EXPECT_EQ(rate, expected);
  }
}

TEST(Deposit, NoCellReceivesMoreThanTheBound) {
  for (const int cells : {8, 16, 40}) {
    Fire fire;
    for (int n = 0; n < 10; ++n) fire.add(Vec3d(.5, .5, .5) + Vec3d(.5, .5, .5) / cells);  // on a cell's centre
    const Grid3<float> rate = fire.rateIn(boxOf(cells));
    const double largest = *std::max_element(rate.values.begin(), rate.values.end());
    EXPECT_NEAR(largest / largestDeposit(10, fire.settings, 1.0 / cells), 1, 1e-5);
  }
}

}  // namespace
}  // namespace brisance
