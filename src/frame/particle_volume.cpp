#include "frame/particle_volume.h"

#include <cmath>

#include "base/parallel.h"
#include "base/stream_copy.h"
#include "base/vector_path.h"
#include "grid/separable_blur.h"

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

/// The drawn particles as points, their places counted in cells of the asked volume; runs of them at once.
struct DrawnPoints {
  const FrameParticles& particles;
  const ParticleVolumeSettings& settings;
  const std::function<float(std::size_t)>& weigh;
  const std::function<Vec3f(float)>& colourOf;

  /// Of a run, the n-th particle's place along an axis.
  auto placeAlong(int axis, std::int64_t first) const {
    const float* places = &particles.position[first].x + axis;
    return [places, corner = settings.corner[axis], perCell = 1 / settings.cellSize](int n) {
      return (double(places[3 * n]) - corner) * perCell - .5;
    };
  }
  /// Rows of cells, -1 for what is not drawn.
  void rowsOf(std::int64_t first, std::int64_t end, std::int32_t* rows) const {
    const int count = static_cast<int>(end - first);
    float mass[sortRun];
    for (int n = 0; n < count; ++n) mass[n] = weigh(first + n);
    runWide([&] {
      const ShareRun share = shares(first, count);
      for (int n = 0; n < count; ++n) rows[n] = mass[n] > 0 ? rowOf(share[n], settings.size.y) : -1;
      for (int axis = 0; axis < 3; ++axis) {
        const auto place = placeAlong(axis, first);
        const double size = settings.size[axis];
        for (int n = 0; n < count; ++n) rows[n] = place(n) >= -.5 && place(n) <= size - .5 ? rows[n] : -1;
      }
    });
  }
  void make(std::int64_t first, std::int64_t end, Point* points) const {
    const int count = static_cast<int>(end - first);
    ShareRun share;
    runWide([&] { share = shares(first, count); });
    for (int n = 0; n < count; ++n) {
      const float mass = weigh(first + n);
      const Vec3f colour = colourOf(particles.temperature[first + n]) * mass;
      points[n] = {share[n], {mass, colour.x, colour.y, colour.z}};
    }
  }

 private:
  ShareRun shares(std::int64_t first, int count) const {
    ShareRun share;
    for (int axis = 0; axis < 3; ++axis) share.set(axis, count, settings.size[axis], placeAlong(axis, first));
    return share;
  }
};

void sortDrawn(const DrawnPoints& drawn, Binned<Point>& points) {
  const std::int64_t rows = static_cast<std::int64_t>(drawn.settings.size.y) * drawn.settings.size.z;
  sortIntoBins(
      static_cast<std::int64_t>(drawn.particles.position.size()), rows,
      [&](std::int64_t first, std::int64_t end, std::int32_t* bins) { drawn.rowsOf(first, end, bins); },
      [&](std::int64_t first, std::int64_t end, Point* made) { drawn.make(first, end, made); }, points);
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

PointBounds boundsOfLayer(const Binned<Point>& points, int rowsPerLayer, int k) {
  PointBounds bounds;
  for (int j = 0; j < rowsPerLayer; ++j)
    for (const Point& point : points.bin(j + static_cast<std::int64_t>(rowsPerLayer) * k))
      bounds.include({{point.lower, j, k}, {point.lower + 1, j + 1, k + 1}});
  return bounds;
}

PointBounds boundsOf(const Binned<Point>& points, const Vec3i& volumeSize) {
  std::vector<PointBounds> ofLayer(volumeSize.z);
  parallelFor(0, volumeSize.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k) ofLayer[k] = boundsOfLayer(points, volumeSize.y, k);
  });
  PointBounds all;
  for (const PointBounds& layer : ofLayer) all.include(layer);
  return all;
}

/// What any particle reaches, and one empty cell more, inside the volume.
CellBox reachedCells(const Binned<Point>& points, int radius, const Vec3i& volumeSize) {
  if (points.items.empty()) return {{0, 0, 0}, {1, 1, 1}};
  const PointBounds bounds = boundsOf(points, volumeSize);
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

/// Named as a vector, for the compiler makes single loads and stores of a loop over threes and fours.
typedef float Vector __attribute__((vector_size(16 * sizeof(float)), aligned(sizeof(float)), may_alias));

/// Density and colour of some cells of a row, on the way from the blurred sums to memory.
struct FinishedCells {
  static constexpr int most = 512, block = 16;
  float density[most], perMass[most], colour[3 * most + 4];

  /// Of the first `count` cells of `sums`, and of more up to a whole block.
  void make(const float* sums, int count, float perVolume) {
    const int rounded = (count + block - 1) / block * block;
    for (int n = 0; n < rounded; ++n) density[n] = sums[channels * n];
    for (int n = 0; n < rounded; ++n) perMass[n] = density[n] > 0 ? 1 / density[n] : 0;
    for (int n = 0; n < rounded; ++n) density[n] *= perVolume;
    for (int n = 0; n < rounded; n += block) {
      const Vector inverse = *reinterpret_cast<const Vector*>(perMass + n);
      meanColours<0>(sums + channels * n, inverse, colour + 3 * n);
      meanColours<4>(sums + channels * n, inverse, colour + 3 * n);
      meanColours<8>(sums + channels * n, inverse, colour + 3 * n);
      meanColours<12>(sums + channels * n, inverse, colour + 3 * n);
    }
  }

 private:
  /// Of four cells of sixteen; the four numbers written beyond theirs those of the next replace.
  template <int n>
  static void meanColours(const float* sums, const Vector& perMass, float* colours) {
    const Vector perMassOf = __builtin_shufflevector(perMass, perMass, n, n, n, n, n + 1, n + 1, n + 1, n + 1, n + 2,
                                                     n + 2, n + 2, n + 2, n + 3, n + 3, n + 3, n + 3);
    const Vector mean = *reinterpret_cast<const Vector*>(sums + channels * n) * perMassOf;
    *reinterpret_cast<Vector*>(colours + 3 * n) =
        __builtin_shufflevector(mean, mean, 1, 2, 3, 5, 6, 7, 9, 10, 11, 13, 14, 15, -1, -1, -1, -1);
  }
};

/// Density and colour of one row from its blurred sums; none outside the span.
void finishRow(const CellSpan& span, const float* sums, float perVolume, int cells, float* density, float* colour) {
  const auto clear = [&](int first, int end) {
    streamZeros(density + first, end - first);
    streamZeros(colour + 3 * first, 3 * (end - first));
  };
  clear(0, span.first);
  FinishedCells some;
  for (int i = span.first; i < span.end; i += FinishedCells::most) {
    const int count = std::min(FinishedCells::most, span.end - i);
    some.make(sums + channels * i, count, perVolume);
    streamCopy(density + i, some.density, count);
    streamCopy(colour + 3 * i, some.colour, 3 * count);
  }
  clear(span.end, cells);
}

BlurTask volumeBlur(const SymmetricFilter& filter, ParticleVolume& volume) {
  const Vec3i size = volume.density.size;
  BlurTask task{.size = size, .channels = channels, .filter = filter, .fill = {}, .finish = {}};
  const double cell = volume.density.cellSize;
  const float perVolume = static_cast<float>(1 / (cell * cell * cell));
  task.finish = [&volume, perVolume, cells = size.x](int j, int k, const CellSpan& span, const float* sums) {
    float* density = &volume.density(0, j, k);
    float* colour = &volume.colour(0, j, k).x;
    runWide([&] { finishRow(span, sums, perVolume, cells, density, colour); });
    endStreaming();
  };
  return task;
}

}  // namespace

void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                    const std::function<float(std::size_t)>& weigh, const std::function<Vec3f(float)>& colourOf,
                    ParticleVolume& volume, SplatScratch& scratch) {
  const SymmetricFilter filter = filterFor(settings);
  Binned<Point>& points = scratch.points;
  sortDrawn({particles, settings, weigh, colourOf}, points);
  const CellBox cells = reachedCells(points, filter.radius(), settings.size);
  layOut(volume.density, cells, settings);
  layOut(volume.colour, cells, settings);
  std::array<std::vector<float>, 3> gain;
  for (int axis = 0; axis < 3; ++axis) gain[axis] = filter.gainInside(settings.size[axis]);
  BlurTask blur = volumeBlur(filter, volume);
  blur.fill = LayerSplat<channels>(points, std::move(gain), cells.lower);
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
