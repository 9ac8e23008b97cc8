#include "particles/particle_order.h"

#include <numeric>

#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr std::int64_t grain = 1 << 14;  // particles per task

/// Rows of the cells that particles lie in; the nearest ones when they lie outside.
void rowsOf(const Vec3d* places, int count, const Grid3<float>& cells, std::int32_t* rows) {
  const double perCell = 1 / cells.cellSize;
  const auto along = [&](const Vec3d& place, int axis) {
    const double cell = (place[axis] - cells.origin[axis]) * perCell + 0.5;
    return static_cast<std::int32_t>(std::min(cell > 0 ? cell : 0.0, cells.size[axis] - 1.0));
  };
  runWide([&] {
    for (int n = 0; n < count; ++n) rows[n] = along(places[n], 1) + cells.size.y * along(places[n], 2);
  });
}

}  // namespace

void sortByRow(ParticleSet& particles, const Grid3<float>& cells, OrderScratch& scratch) {
  const std::int64_t count = static_cast<std::int64_t>(particles.size());
  sortIntoBins(
      count, static_cast<std::int64_t>(cells.size.y) * cells.size.z,
      [&](std::int64_t first, std::int64_t end, std::int32_t* rows, std::uint32_t* items) {
        rowsOf(particles.position.data() + first, static_cast<int>(end - first), cells, rows);
        std::iota(items, items + (end - first), static_cast<std::uint32_t>(first));
      },
      scratch.order);
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
