#include "frame/particle_volume.h"

#include <sys/mman.h>

#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "frame/splat_rows.h"

namespace brisance {

namespace {

constexpr double filterDeviations = 3;  // where the Gaussian ends unless a width is asked for
constexpr int rowsPerTask = 4;

GaussianFilter filterFor(const ParticleVolumeSettings& settings) {
  const double deviation = settings.blur / settings.cellSize;
  const int radius =
      settings.filterSize > 0 ? settings.filterSize / 2 : static_cast<int>(std::ceil(filterDeviations * deviation));
  return {deviation, radius};
}

/// A drawn particle: where it is in cells, (0, 0, 0) being the first cell's centre, and what it adds.
struct DrawnParticle {
  Vec3d place;
  std::array<float, 4> amount;
};

std::vector<DrawnParticle> drawnParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                                          const std::function<float(std::size_t)>& weigh,
                                          const std::function<Vec3f(float)>& colourOf) {
  const Vec3d half(.5, .5, .5);
  const Box3 inside{Vec3d() - half, Vec3d(settings.size) - half};
  std::vector<DrawnParticle> drawn;
  for (std::size_t n = 0; n < particles.position.size(); ++n) {
    const float mass = weigh(n);
    const Vec3d place = (Vec3d(particles.position[n]) - settings.corner) / settings.cellSize - half;
    if (!(mass > 0) || !inside.contains(place)) continue;
    const Vec3f colour = colourOf(particles.temperature[n]) * mass;
    drawn.push_back({place, {mass, colour.x, colour.y, colour.z}});
  }
  return drawn;
}

/// Cells of the asked volume, by their numbers.
struct CellBox {
  Vec3i lower, size;
};

/// What any particle reaches, and one empty cell more, inside the volume.
CellBox reachedCells(const std::vector<DrawnParticle>& drawn, int radius, const Vec3i& volumeSize) {
  if (drawn.empty()) return {{0, 0, 0}, {1, 1, 1}};
  Box3 box;
  for (const DrawnParticle& particle : drawn) box.include(particle.place);
  CellBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    const int lower = static_cast<int>(std::floor(box.lower[axis])) - radius - 1;
    const int upper = static_cast<int>(std::floor(box.upper[axis])) + 1 + radius + 1;
    cells.lower[axis] = std::max(0, lower);
    cells.size[axis] = std::min(volumeSize[axis] - 1, upper) + 1 - cells.lower[axis];
  }
  return cells;
}

/// Linear between the two cell centres around `place`; `gain` makes up for what the filter would lose at a face.
AxisShare shareOf(double place, int firstCell, const std::vector<float>& gain) {
  const int last = static_cast<int>(gain.size()) - 1, cell = static_cast<int>(std::floor(place));
  const int lower = std::clamp(cell, 0, last), upper = std::clamp(cell + 1, 0, last);
  const float fraction = static_cast<float>(place - cell);
  return {lower - firstCell, upper - firstCell, (1 - fraction) * gain[lower], fraction * gain[upper]};
}

/// Counting sort by row, so that each row sums its splats in the particles' order.
SortedSplats sortByRow(const std::vector<Splat>& splats, int rows) {
  SortedSplats sorted{std::vector<Splat>(splats.size()), std::vector<std::uint32_t>(rows + 1, 0)};
  for (const Splat& splat : splats) ++sorted.rowStart[splat.share[1].lower + 1];
  for (int j = 0; j < rows; ++j) sorted.rowStart[j + 1] += sorted.rowStart[j];
  std::vector<std::uint32_t> next = sorted.rowStart;
  for (const Splat& splat : splats) sorted.splats[next[splat.share[1].lower]++] = splat;
  return sorted;
}

SortedSplats makeSplats(const std::vector<DrawnParticle>& drawn, const CellBox& cells, const GaussianFilter& filter,
                        const Vec3i& volumeSize) {
  std::array<std::vector<float>, 3> gain;
  for (int axis = 0; axis < 3; ++axis) gain[axis] = filter.gainInside(volumeSize[axis]);
  std::vector<Splat> splats(drawn.size());
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    splats[n].amount = drawn[n].amount;
    for (int axis = 0; axis < 3; ++axis)
      splats[n].share[axis] = shareOf(drawn[n].place[axis], cells.lower[axis], gain[axis]);
  }
  return sortByRow(splats, cells.size.y);
}

/// Sets the number of values; fresh memory is asked for in large pages, whose first touch is many times cheaper.
template <class T>
void resizeForOverwriting(std::vector<T>& values, std::size_t count) {
  if (count > values.capacity()) {
    values = {};
    values.reserve(count);
    constexpr std::uintptr_t page = 1 << 21;  // bytes
    const auto start = (reinterpret_cast<std::uintptr_t>(values.data()) + page - 1) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity()) / page * page;
    if (end > start) ::madvise(reinterpret_cast<void*>(start), end - start, MADV_HUGEPAGE);  // only a hint
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

}  // namespace

void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                    const std::function<float(std::size_t)>& weigh, const std::function<Vec3f(float)>& colourOf,
                    ParticleVolume& volume) {
  const GaussianFilter filter = filterFor(settings);
  const auto drawn = drawnParticles(particles, settings, weigh, colourOf);
  const CellBox cells = reachedCells(drawn, filter.radius(), settings.size);
  const SortedSplats sorted = makeSplats(drawn, cells, filter, settings.size);
  layOut(volume.density, cells, settings);
  layOut(volume.colour, cells, settings);
  parallelFor(0, cells.size.y, rowsPerTask, [&](std::int64_t first, std::int64_t last) {
    fillRows(sorted, filter, static_cast<int>(first), static_cast<int>(last), volume);
  });
}

ParticleVolume splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                              const std::function<float(std::size_t)>& weigh,
                              const std::function<Vec3f(float)>& colourOf) {
  ParticleVolume volume;
  splatParticles(particles, settings, weigh, colourOf, volume);
  return volume;
}

}  // namespace brisance
