#include "frame/particle_volume.h"

#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {

constexpr double filterDeviations = 3;  // where the Gaussian ends unless a width is asked for
constexpr int channels = 4;             // mass, and mass times red, green, blue
using Point = SplatPoint<channels>;

SymmetricFilter filterFor(const ParticleVolumeSettings& settings) {
  const double deviation = settings.blur / settings.cellSize;
  const int radius =
      settings.filterSize > 0 ? settings.filterSize / 2 : static_cast<int>(std::ceil(filterDeviations * deviation));
  return gaussianFilter(deviation, radius);
}

/// The drawn particles, their places counted in cells of the asked volume.
void sortDrawn(const FrameParticles& particles, const ParticleVolumeSettings& settings,
               const std::function<float(std::size_t)>& weigh, const std::function<Vec3f(float)>& colourOf,
               Binned<Point>& points) {
  const Vec3d half(.5, .5, .5);
  const Box3 inside{Vec3d() - half, Vec3d(settings.size) - half};
  const auto make = [&](std::int64_t n, Point& point) -> std::int64_t {
    const float mass = weigh(n);
    const Vec3d place = (Vec3d(particles.position[n]) - settings.corner) / settings.cellSize - half;
    if (!(mass > 0) || !inside.contains(place)) return -1;
    const Vec3f colour = colourOf(particles.temperature[n]) * mass;
    point.amount = {mass, colour.x, colour.y, colour.z};
    for (int axis = 0; axis < 3; ++axis) point.share[axis] = axisShare(place[axis], settings.size[axis]);
    return rowOf(point, settings.size.y);
  };
  const std::int64_t rows = static_cast<std::int64_t>(settings.size.y) * settings.size.z;
  sortIntoBins(static_cast<std::int64_t>(particles.position.size()), rows, make, points);
}

/// Cells of the asked volume, by their numbers.
struct CellBox {
  Vec3i lower, size;
};

/// The cells before which and after which no point lies.
struct PointBounds {
  Vec3i lower{1 << 30, 1 << 30, 1 << 30}, upper{-1, -1, -1};
  void include(const PointBounds& other) {
    lower = min(lower, other.lower);
    upper = max(upper, other.upper);
  }
};

PointBounds boundsOf(const std::vector<Point>& points) {
  constexpr std::int64_t blockSize = 1 << 14;
  const std::int64_t count = std::ssize(points), blocks = (count + blockSize - 1) / blockSize;
  std::vector<PointBounds> ofBlock(blocks);
  parallelFor(0, blocks, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t block = first; block < last; ++block)
      for (std::int64_t n = block * blockSize; n < std::min(count, (block + 1) * blockSize); ++n) {
        const auto& [x, y, z] = points[n].share;
        ofBlock[block].include({{x.lower, y.lower, z.lower}, {x.lower + 1, y.lower + 1, z.lower + 1}});
      }
  });
  PointBounds all;
  for (const PointBounds& block : ofBlock) all.include(block);
  return all;
}

/// What any particle reaches, and one empty cell more, inside the volume.
CellBox reachedCells(const Binned<Point>& points, int radius, const Vec3i& volumeSize) {
  if (points.items.empty()) return {{0, 0, 0}, {1, 1, 1}};
  const PointBounds bounds = boundsOf(points.items);
  const Vec3i rim(radius + 1, radius + 1, radius + 1);
  const Vec3i lower = max(Vec3i(0, 0, 0), bounds.lower - rim);
  return {lower, min(volumeSize - Vec3i(1, 1, 1), bounds.upper + rim) - lower + Vec3i(1, 1, 1)};
}

/// Sets the number of values without copying those there are.
template <class T>
void resizeForOverwriting(AlignedVector<T>& values, std::size_t count) {
  if (count > values.capacity()) {
    values = {};
    values.reserve(count);
  }
  values.resize(count);
}

template <class T>
void layOut(Grid3<T>& grid, const CellBox& cells, const ParticleVolumeSettings& settings) {
  grid.size = cells.size;
  grid.cellSize = settings.cellSize;
  grid.origin = settings.corner + (Vec3d(cells.lower) + Vec3d(.5, .5, .5)) * settings.cellSize;
  resizeForOverwriting(grid.values, static_cast<std::size_t>(cells.size.x) * cells.size.y * cells.size.z);
}

/// Density and colour of one row from its blurred sums; none outside the span.
void finishRow(const CellSpan& span, float* const* sums, float perVolume, int cells, float* density, Vec3f* colour) {
  std::fill(density, density + span.first, 0.f);
  std::fill(colour, colour + span.first, Vec3f());
  for (int i = span.first; i < span.end; ++i) {
    const float mass = sums[0][i], perMass = mass > 0 ? 1 / mass : 0;
    density[i] = mass * perVolume;
    colour[i] = {sums[1][i] * perMass, sums[2][i] * perMass, sums[3][i] * perMass};
  }
  std::fill(density + span.end, density + cells, 0.f);
  std::fill(colour + span.end, colour + cells, Vec3f());
}

BlurTask volumeBlur(const SymmetricFilter& filter, ParticleVolume& volume) {
  const Vec3i size = volume.density.size;
  BlurTask task{.size = size, .channels = channels, .filter = filter, .fill = {}, .finish = {}};
  const double cell = volume.density.cellSize;
  const float perVolume = static_cast<float>(1 / (cell * cell * cell));
  task.finish = [&volume, perVolume, cells = size.x](int j, int k, const CellSpan& span, float* const* sums) {
    float* density = &volume.density(0, j, k);
    Vec3f* colour = &volume.colour(0, j, k);
    runWide([&] { finishRow(span, sums, perVolume, cells, density, colour); });
  };
  return task;
}

}  // namespace

void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                    const std::function<float(std::size_t)>& weigh, const std::function<Vec3f(float)>& colourOf,
                    ParticleVolume& volume, SplatScratch& scratch) {
  const SymmetricFilter filter = filterFor(settings);
  Binned<Point>& points = scratch.points;
  sortDrawn(particles, settings, weigh, colourOf, points);
  const CellBox cells = reachedCells(points, filter.radius(), settings.size);
  layOut(volume.density, cells, settings);
  layOut(volume.colour, cells, settings);
  std::array<std::vector<float>, 3> gain;
  for (int axis = 0; axis < 3; ++axis) gain[axis] = filter.gainInside(settings.size[axis]);
  BlurTask blur = volumeBlur(filter, volume);
  const RowSplat<channels> splat{points, gain, cells.lower.x};
  blur.fill = [&](int j, int k, float* row) { return splat(j + cells.lower.y, k + cells.lower.z, row); };
  blurSeparably(blur);
}

ParticleVolume splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                              const std::function<float(std::size_t)>& weigh,
                              const std::function<Vec3f(float)>& colourOf) {
  ParticleVolume volume;
  SplatScratch scratch;
  splatParticles(particles, settings, weigh, colourOf, volume, scratch);
  return volume;
}

}  // namespace brisance
