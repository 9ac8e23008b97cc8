#include "particles/particle_order.h"

#include <cmath>

namespace brisance {

namespace {
constexpr std::int64_t grain = 1 << 14;  // particles per task

/// Row of the cells that `place` lies in; the nearest one when it lies outside.
struct RowOf {
  Vec3i size;
  Vec3d origin;
  double cellSize;

  std::int64_t operator()(const Vec3d& place) const {
    return along(place, 1) + static_cast<std::int64_t>(size.y) * along(place, 2);
  }

 private:
  int along(const Vec3d& place, int axis) const {
    const double cell = (place[axis] - origin[axis]) / cellSize + 0.5;
    return static_cast<int>(std::min(cell > 0 ? cell : 0.0, size[axis] - 1.0));
  }
};

}  // namespace

void sortByRow(ParticleSet& particles, const Grid3<float>& cells, OrderScratch& scratch) {
  const RowOf rowOf{cells.size, cells.origin, cells.cellSize};
  const std::int64_t count = static_cast<std::int64_t>(particles.size());
  sortIntoBins(
      count, static_cast<std::int64_t>(rowOf.size.y) * rowOf.size.z,
      [&](std::int64_t n) { return rowOf(particles.position[n]); },
      [](std::int64_t n) { return static_cast<std::uint32_t>(n); }, scratch.order);
  const AlignedVector<std::uint32_t>& order = scratch.order.items;
  const auto sortField = [&](auto& field, auto& sorted) {
    sorted.resize(field.size());
    parallelFor(0, count, grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t n = first; n < last; ++n) sorted[n] = field[order[n]];
    });
    field.swap(sorted);
  };
  forEachField(particles, scratch.sorted, sortField);
}
}  // namespace brisance
