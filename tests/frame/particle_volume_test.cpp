#include "frame/particle_volume.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"

namespace brisance {
namespace {

constexpr float particleMass = 1e-3f;  // [kg]

float equalMass(std::size_t) { return particleMass; }
/// Red to blue with the temperature [K], which the tests use from 0 to 1.
Vec3f mixedColour(float temperature) { return {1 - temperature, 0.25f, temperature}; }

void addParticle(FrameParticles& particles, const Vec3d& place, float temperature) {
  particles.position.emplace_back(place);
  particles.velocity.emplace_back();
  particles.mass.push_back(particleMass);
  particles.temperature.push_back(temperature);
  particles.kind.push_back(1);
}

ParticleVolumeSettings smallVolume() {
  return {.size = {40, 50, 60}, .corner = {-1, 2, 3}, .cellSize = 0.1, .blur = 0.23, .filterSize = 0};
}

/// Anywhere in the volume, its borders included.
FrameParticles spreadParticles(int count, const ParticleVolumeSettings& settings, std::uint64_t seed) {
  const Random random(seed, Stream::test);
  FrameParticles particles;
  for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(count); ++n) {
    const Vec3d share(random.uniform(4 * n), random.uniform(4 * n + 1), random.uniform(4 * n + 2));
    addParticle(particles, settings.corner + share * Vec3d(settings.size) * settings.cellSize,
                static_cast<float>(random.uniform(4 * n + 3)));
  }
  return particles;
}

double massOf(const ParticleVolume& volume) {
  double sum = 0;
  for (const float density : volume.density.values) sum += density;
  return sum * volume.density.cellSize * volume.density.cellSize * volume.density.cellSize;
}

// Each cell's mass passes about ten roundings to single precision, all relative.
constexpr double rounding = 10 * 6e-8;

TEST(ParticleVolume, KeepsTheMassOfParticlesUpToTheBorder) {
  const auto settings = smallVolume();
  for (const int count : {1, 10, 3000}) {
    const auto volume = splatParticles(spreadParticles(count, settings, 1), settings, equalMass, mixedColour);
    EXPECT_NEAR(massOf(volume), count * double(particleMass), count * double(particleMass) * rounding);
  }
}

/// The definition, cell by cell: shares of eight cells, then the filter along each axis, narrowed at the faces.
double exactDensity(const FrameParticles& particles, const ParticleVolumeSettings& s, const Vec3i& cell) {
  const double deviation = s.blur / s.cellSize;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto weight = [&](int t) {
    return std::abs(t) > radius ? 0 : std::exp(-0.5 * t * t / (deviation * deviation));
  };
  const auto spreadFrom = [&](int from, int to, int count) {
    double inside = 0;
    for (int other = 0; other < count; ++other) inside += weight(other - from);
    return weight(to - from) / inside;
  };
  double sum = 0;
  for (std::size_t n = 0; n < particles.position.size(); ++n) {
    const Vec3d p = (Vec3d(particles.position[n]) - s.corner) / s.cellSize - Vec3d(.5, .5, .5);
    double share = particleMass;
    for (int axis = 0; axis < 3; ++axis) {
      const int lower = static_cast<int>(std::floor(p[axis])), count = s.size[axis];
      const double f = p[axis] - lower;
      share *= (1 - f) * spreadFrom(std::max(lower, 0), cell[axis], count) +
               f * spreadFrom(std::min(lower + 1, count - 1), cell[axis], count);
    }
    sum += share;
  }
  return sum / (s.cellSize * s.cellSize * s.cellSize);
}

TEST(ParticleVolume, IsTheSeparableGaussianOfTheSharedMasses) {
  const auto settings = smallVolume();
  const auto particles = spreadParticles(200, settings, 2);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  ASSERT_EQ(volume.density.size, settings.size);
  const Random random(3, Stream::test);
  for (std::uint64_t n = 0; n < 500; ++n) {
    const Vec3i cell(static_cast<int>(random.below(40, 3 * n)), static_cast<int>(random.below(50, 3 * n + 1)),
                     static_cast<int>(random.below(60, 3 * n + 2)));
    const double exact = exactDensity(particles, settings, cell);
    // Places are single precision: 5 m to 3e-7 m of a deviation of 0.23 m.
    ASSERT_NEAR(volume.density(cell.x, cell.y, cell.z), exact, exact * (rounding + 1e-5));
  }
}

TEST(ParticleVolume, ColourIsTheMeanOfTheColoursThere) {
  const auto settings = smallVolume();
  const auto one = [](float) { return Vec3f(0.2f, 0.5f, 4); };
  const auto volume = splatParticles(spreadParticles(500, settings, 4), settings, equalMass, one);
  for (std::int64_t n = 0; n < volume.density.count(); ++n) {
    const Vec3f colour = volume.colour.values[n], expected = volume.density.values[n] > 0 ? one(0) : Vec3f();
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(colour[c], expected[c], expected[c] * 2 * rounding);
  }
}

TEST(ParticleVolume, ColourOfAMixtureLiesBetweenItsParts) {
  auto settings = smallVolume();
  FrameParticles particles;
  addParticle(particles, {0.95, 4, 6}, 0);
  addParticle(particles, {1.05, 4, 6}, 1);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  // The particles are mirror images in a face of cells: the mean of the cells beside it is the colour on it.
  const Vec3d p = (Vec3d(1, 4, 6) - volume.colour.origin) / volume.colour.cellSize;
  const int i = static_cast<int>(p.x), j = static_cast<int>(p.y), k = static_cast<int>(p.z);
  const Vec3f middle = (volume.colour(i, j, k) + volume.colour(i + 1, j, k)) * 0.5f;
  EXPECT_NEAR(middle.x, 0.5, 1e-5);
  EXPECT_NEAR(middle.z, 0.5, 1e-5);
  EXPECT_NEAR(middle.y, 0.25, 1e-6);
}

TEST(ParticleVolume, MirroredParticlesGiveTheMirroredVolume) {
  // Powers of two, so that mirrored places are exact.
  const ParticleVolumeSettings settings{.size = {32, 32, 32}, .corner = {-2, -2, -2}, .cellSize = 0.125, .blur = 0.25};
  FrameParticles particles, mirrored;
  const Random random(5, Stream::test);
  for (std::uint64_t n = 0; n < 50; ++n) {
    const Vec3d p =
        Vec3d(random.uniform(3 * n), random.uniform(3 * n + 1), random.uniform(3 * n + 2)) * 4.0 - Vec3d(2, 2, 2);
    addParticle(particles, p, 0.5f);
    addParticle(mirrored, -p, 0.5f);
  }
  const auto a = splatParticles(particles, settings, equalMass, mixedColour);
  const auto b = splatParticles(mirrored, settings, equalMass, mixedColour);
  ASSERT_EQ(a.density.size, Vec3i(32, 32, 32));
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i)
        ASSERT_NEAR(a.density(i, j, k), b.density(31 - i, 31 - j, 31 - k), a.density(i, j, k) * 2e-5);
}

TEST(ParticleVolume, CoversOnlyWhatTheParticlesReachAndEndsInEmptyCells) {
  const auto settings = smallVolume();
  FrameParticles particles;
  addParticle(particles, {1.03, 4.51, 6.02}, 0.5f);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  const int reach = 2 * (7 + 1) + 2;  // three deviations of 2.3 cells and an empty one each way, two cells share
  EXPECT_EQ(volume.density.size, Vec3i(reach, reach, reach));
  const Vec3d offset = (volume.density.origin - settings.corner) / settings.cellSize - Vec3d(.5, .5, .5);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(offset[axis], std::round(offset[axis]), 1e-9);
  for (int n = 0; n < reach; ++n)
    for (int m = 0; m < reach; ++m) {
      EXPECT_EQ(volume.density(0, n, m) + volume.density(n, 0, m) + volume.density(n, m, 0), 0);
      EXPECT_EQ(volume.density(reach - 1, n, m) + volume.density(n, reach - 1, m) + volume.density(n, m, reach - 1), 0);
    }
  EXPECT_NEAR(massOf(volume), particleMass, particleMass * rounding);
}

TEST(ParticleVolume, CentreOfMassStaysWhereTheParticleIs) {
  const auto settings = smallVolume();
  FrameParticles particles;
  const Vec3d place(1.0625, 4.53125, 6.03125);
  addParticle(particles, place, 0.5f);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  Vec3d sum;
  double mass = 0;
  for (int k = 0; k < volume.density.size.z; ++k)
    for (int j = 0; j < volume.density.size.y; ++j)
      for (int i = 0; i < volume.density.size.x; ++i) {
        sum += volume.density.position(i, j, k) * volume.density(i, j, k);
        mass += volume.density(i, j, k);
      }
  EXPECT_NEAR(length(sum / mass - place), 0, settings.cellSize * 1e-5);
}

TEST(ParticleVolume, WithoutParticlesIsOneEmptyCell) {
  const auto nothing = [](std::size_t) { return 0.f; };
  const auto settings = smallVolume();
  for (const auto& volume : {splatParticles({}, settings, equalMass, mixedColour),
                             splatParticles(spreadParticles(9, settings, 6), settings, nothing, mixedColour)}) {
    EXPECT_EQ(volume.density.values, decltype(volume.density.values){0});
    EXPECT_EQ(volume.colour.values, decltype(volume.colour.values){Vec3f()});
  }
}

TEST(ParticleVolume, LeavesOutWhatLiesOutsideOrNowhere) {
  const auto settings = smallVolume();
  FrameParticles particles;
  addParticle(particles, {1, 4, 6}, 0.5f);
  addParticle(particles, {-1.01, 4, 6}, 0.5f);
  addParticle(particles, {1, 4, 9.01}, 0.5f);
  addParticle(particles, {1, NAN, 6}, 0.5f);
  addParticle(particles, {1, 4, INFINITY}, 0.5f);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  EXPECT_NEAR(massOf(volume), particleMass, particleMass * rounding);
}

TEST(ParticleVolume, NoBlurLeavesTheEightShares) {
  auto settings = smallVolume();
  settings.blur = 0;
  FrameParticles particles;
  addParticle(particles, {1, 4, 6}, 0.5f);  // on a corner of cells
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  int filled = 0;
  for (const float density : volume.density.values) filled += density > particleMass / 8 * 999;
  EXPECT_EQ(filled, 8);
}

TEST(ParticleVolume, AGivenFilterSizeIsItsWidthInCells) {
  auto settings = smallVolume();
  settings.filterSize = 5;
  FrameParticles particles;
  addParticle(particles, {1.05, 4.05, 6.05}, 0.5f);  // on a cell's centre, but for the rounding of its place
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  int filled = 0;
  for (const float density : volume.density.values) filled += density > 1e-3;
  EXPECT_EQ(filled, 5 * 5 * 5);
}

bool sameBits(const ParticleVolume& a, const ParticleVolume& b) {
  return a.density == b.density && a.colour == b.colour;
}

double magnitude(float value) { return std::abs(value); }
double magnitude(const Vec3f& value) { return length(Vec3d(value)); }

/// The largest difference, over the largest value.
template <class T>
double difference(const Grid3<T>& a, const Grid3<T>& b) {
  EXPECT_EQ(a.size, b.size);
  double away = 0, largest = 0;
  for (std::int64_t n = 0; n < a.count(); ++n) {
    away = std::max(away, magnitude(a.values[n] - b.values[n]));
    largest = std::max(largest, magnitude(b.values[n]));
  }
  return away / largest;
}

TEST(ParticleVolume, HasTheSameBitsForAnyNumberOfThreadsAndNearlyForAnyVectors) {
  auto settings = smallVolume();
  const auto particles = spreadParticles(2000, settings, 7);
  const auto volumeBy = [&](VectorPath path, int threads) {
    const ThreadLimit limit(threads);
    forceVectorPath(path);
    return splatParticles(particles, settings, equalMass, mixedColour);
  };
  const VectorPath before = vectorPath();
  for (const int width : {0, 3, 5, 7, 9}) {  // any, and those with loops of their own
    settings.filterSize = width;
    const auto plain = volumeBy(VectorPath::plain, 1);
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      const auto expected = volumeBy(path, 1);
      for (const int threads : {2, 5}) EXPECT_TRUE(sameBits(volumeBy(path, threads), expected)) << width;
      // Where products are added without a rounding in between.
      EXPECT_LT(difference(expected.density, plain.density), rounding) << width;
      EXPECT_LT(difference(expected.colour, plain.colour), 2 * rounding) << width;
    }
  }
  forceVectorPath(before);
}

TEST(ParticleVolume, RowsOfAnyLengthHoldAll) {
  auto settings = smallVolume();
  settings.filterSize = 5;
  const VectorPath before = vectorPath();
  for (const int cells : {2, 15, 17, 63, 159, 161, 175, 320}) {  // around lines of memory, and pieces of rows
    settings.size = {cells, 13, 9};
    const auto particles = spreadParticles(20 * cells, settings, 11);
    forceVectorPath(VectorPath::plain);
    const auto plain = splatParticles(particles, settings, equalMass, mixedColour);
    ASSERT_EQ(plain.density.size, settings.size);
    forceVectorPath(before);
    const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
    EXPECT_LT(difference(volume.density, plain.density), rounding) << cells;
    EXPECT_LT(difference(volume.colour, plain.colour), 2 * rounding) << cells;
    EXPECT_NEAR(massOf(volume), 20 * cells * double(particleMass), cells * double(particleMass) * 20 * rounding);
  }
}

TEST(ParticleVolume, TwoCloudsFarApartLeaveAllBetweenThemEmpty) {
  auto settings = smallVolume();
  settings.size = {150, 70, 70};
  FrameParticles particles;
  addParticle(particles, {0, 3, 4}, 0.5f);
  addParticle(particles, {13, 8, 9}, 0.5f);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  EXPECT_NEAR(massOf(volume), 2 * particleMass, 2 * particleMass * rounding);
  int filled = 0;
  for (std::int64_t n = 0; n < volume.density.count(); ++n) {
    filled += volume.density.values[n] > 0;
    ASSERT_EQ(volume.density.values[n] > 0, volume.colour.values[n].y > 0);
  }
  EXPECT_LE(filled, 2 * 16 * 16 * 16);  // two cells, and seven more each way
  EXPECT_GT(filled, 2 * 14 * 14 * 14);
}

TEST(ParticleVolume, AVolumeOfOneCellHoldsAll) {
  auto settings = smallVolume();
  settings.size = {1, 1, 1};
  FrameParticles particles;
  addParticle(particles, {-.98, 2.05, 3.07}, 0.5f);
  const auto volume = splatParticles(particles, settings, equalMass, mixedColour);
  EXPECT_NEAR(massOf(volume), particleMass, particleMass * rounding);
}

TEST(ParticleVolume, MemoryUsedAgainLeavesNoTrace) {
  const auto settings = smallVolume();
  const auto few = spreadParticles(3, settings, 8), many = spreadParticles(2000, settings, 9);
  ParticleVolume volume;
  SplatScratch scratch;
  for (const auto* particles : {&many, &few, &many}) {
    splatParticles(*particles, settings, equalMass, mixedColour, volume, scratch);
    EXPECT_TRUE(sameBits(volume, splatParticles(*particles, settings, equalMass, mixedColour)));
  }
}

}  // namespace
}  // namespace brisance
