#include "frame/particle_volume.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/stream_copy.h"
#include "base/vector_path.h"
#include "frame/finished_cells.h"
#include "grid/separable_blur.h"

namespace brisance {

namespace {

constexpr double filterDeviations = 3;  // where the Gaussian ends unless a width is asked for
constexpr int channels = sumsPerCell;
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
  const ParticleLook& look;

  /// Of a run, the n-th particle's place along an axis.
  auto placeAlong(int axis, std::int64_t first) const {
    const float* places = &particles.position[first].x + axis;
    return [places, corner = settings.corner[axis], perCell = 1 / settings.cellSize](int n) {
      return (double(places[3 * n]) - corner) * perCell - .5;
    };
  }
  /// Rows of cells, -1 for what is not drawn; the cells that the others reach along x.
  CellSpan make(std::int64_t first, std::int64_t end, std::int32_t* rows, Point* points) const {
    const int count = static_cast<int>(end - first);
    float mass[sortRun];
    Vec3f colour[sortRun];
    look.weigh(first, count, mass);
    look.colour(particles.temperature.data() + first, count, colour);
    ShareRun share;
    CellSpan reached;
    runWide([&] {
      std::int32_t hidden[sortRun];
      for (int n = 0; n < count; ++n) hidden[n] = !(mass[n] > 0);
      setShares(first, count, share, hidden);
      reached = findRows(count, hidden, share, rows);
    });
    for (int n = 0; n < count; ++n) {
      const Vec3f amount = colour[n] * mass[n];
      points[n] = {share[n], {mass[n], amount.x, amount.y, amount.z}};
    }
    return reached;
  }

 private:
  /// And sets hidden[n] where the place is not in the volume.
  void setShares(std::int64_t first, int count, ShareRun& share, std::int32_t* hidden) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double last = settings.size[axis] - .5;
      share.set(axis, count, settings.size[axis], placeAlong(axis, first),
                [=](int n, double at) { hidden[n] |= std::int32_t{!(at >= -.5)} | std::int32_t{!(at <= last)}; });
    }
  }
  CellSpan findRows(int count, const std::int32_t* hidden, const ShareRun& share, std::int32_t* rows) const {
    const BandedRows numbers(settings.size.y, settings.size.z);
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) {
      const std::int32_t row = share.rowOf(n, numbers);
      rows[n] = hidden[n] ? -1 : row;
    }
    constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
    std::int32_t lowest = largest, highest = -1;
    for (int n = 0; n < count; ++n) {
      const std::int32_t x = share.lower[0][n], none = rows[n] >> 31;
      lowest = std::min(lowest, x | (none & largest));
      highest = std::max(highest, x | none);
    }
    return {lowest, highest + 1};
  }
};

void sortDrawn(const DrawnPoints& drawn, SplatScratch& scratch) {
  const std::int64_t count = std::ssize(drawn.particles.position),
                     rows = BandedRows(drawn.settings.size.y, drawn.settings.size.z).count();
  scratch.reachAlongX.assign(static_cast<std::size_t>((count + sortRun - 1) / sortRun), {});
  sortIntoBins(
      count, rows,
      [&](std::int64_t first, std::int64_t end, std::int32_t* bins, Point* made) {
        scratch.reachAlongX[first / sortRun] = drawn.make(first, end, bins, made);
      },
      scratch.points);
}

/// Cells of the asked volume, by their numbers.
struct CellBox {
  Vec3i lower, size;
};

/// The cells before which and after which no point's lower neighbours lie.
struct PointBounds {
  Vec3i lower, upper;
};

PointBounds boundsOf(const SplatScratch& scratch, const Vec3i& volumeSize) {
  CellSpan x, y, z;
  for (const CellSpan& reach : scratch.reachAlongX) x.include(reach);
  const BandedRows rows(volumeSize.y, volumeSize.z);
  for (int k = 0; k < volumeSize.z; ++k)
    for (int j = 0; j < volumeSize.y; ++j) {
      if (scratch.points.bin(rows(j, k)).empty()) continue;
      y.include({j, j + 1});
      z.include({k, k + 1});
    }
  return {{x.first, y.first, z.first}, {x.end, y.end, z.end}};
}

/// What any particle reaches, and one empty cell more, inside the volume.
CellBox reachedCells(const SplatScratch& scratch, int radius, const Vec3i& volumeSize) {
  if (scratch.points.items.empty()) return {{0, 0, 0}, {1, 1, 1}};
  const PointBounds bounds = boundsOf(scratch, volumeSize);
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

/// Where the rows of the volume lie; all of them start at whole numbers of cells from the start of a line of memory.
struct VolumeRows {
  ParticleVolume& volume;
  float perVolume;

  /// Takes what of the row lies in lines of memory that end before the piece's end, or with the row.
  void finish(int j, int k, const CellSpan& piece, const CellSpan& filled, const float* sums) const {
    const std::int64_t row = volume.density.index(0, j, k);
    const auto wholeLines = [&](int cell) {
      const int beyond = static_cast<int>((row + cell) % cellsPerLine);
      return cell == volume.density.size.x ? cell : std::max(0, cell - beyond);
    };
    const int first = wholeLines(piece.first), count = wholeLines(piece.end) - first;
    float* density = volume.density.values.data() + row + first;
    float* colour = &volume.colour.values.data()[row + first].x;
    if (piece.first == 0) fetchLastLines(density + volume.density.size.x, colour + 3 * volume.density.size.x);
    if (filled.end <= first || filled.first >= first + count) {
      streamZeros(density, count);
      streamZeros(colour, 3 * count);
    } else {
      finishCells(sums + channels * first, count, perVolume, density, colour);
    }
  }
};

BlurTask volumeBlur(const SymmetricFilter& filter, ParticleVolume& volume) {
  const Vec3i size = volume.density.size;
  BlurTask task{.size = size, .channels = channels, .filter = filter, .fill = {}, .finish = {}};
  const double cell = volume.density.cellSize;
  const float perVolume = static_cast<float>(1 / (cell * cell * cell));
  task.finish = [rows = VolumeRows{volume, perVolume}](int j, int k, const CellSpan& piece, const CellSpan& filled,
                                                       const float* sums) { rows.finish(j, k, piece, filled, sums); };
  task.finished = endStreaming;
  return task;
}

}  // namespace

void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings, const ParticleLook& look,
                    ParticleVolume& volume, SplatScratch& scratch) {
  const SymmetricFilter filter = filterFor(settings);
  sortDrawn({particles, settings, look}, scratch);
  const CellBox cells = reachedCells(scratch, filter.radius(), settings.size);
  layOut(volume.density, cells, settings);
  layOut(volume.colour, cells, settings);
  std::array<std::vector<float>, 3> gain;
  for (int axis = 0; axis < 3; ++axis) gain[axis] = filter.gainInside(settings.size[axis]);
  BlurTask blur = volumeBlur(filter, volume);
  blur.fill = LayerSplat<channels>(scratch.points, std::move(gain), cells.lower);
  blurSeparably(blur);
}

}  // namespace brisance
