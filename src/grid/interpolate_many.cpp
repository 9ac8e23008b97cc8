#include "grid/interpolate_many.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "base/row_lines.h"
#include "base/vector_path.h"
#include "grid/interpolate.h"

namespace brisance {

namespace {

constexpr int blockPlaces = PlaceBlock::most;  // whose corners stay in the nearest cache

/// Of some places, along one axis: the cells between samples that they lie in, and how far into them.
struct AxisCells {
  alignas(64) std::int32_t cell[blockPlaces];
  alignas(64) float share[blockPlaces];
};
using PlaceCells = std::array<const AxisCells*, 3>;

/// For some places: the first corner of their cells, and the values at the corners, in pairs along x.
struct Corners {
  alignas(64) std::int32_t first[blockPlaces];
  alignas(64) float pair[4][2 * blockPlaces];
};

/// Beyond the samples the outermost cell, all of it.
inline void findCells(const double* places, int count, int axis, const Grid3<float>& grid, AxisCells& cells) {
  const double origin = grid.origin[axis], last = grid.size[axis] - 1.0, inverse = 1 / grid.cellSize;
  const int lastCell = grid.size[axis] - 2;
  for (int n = 0; n < count; ++n) {
    const double x = (places[n] - origin) * inverse;
    const double inside = std::min(x > 0 ? x : 0.0, last);
    cells.cell[n] = std::min(static_cast<int>(inside), lastCell);
    cells.share[n] = static_cast<float>(inside - cells.cell[n]);
  }
}

inline void findCorners(const PlaceCells& along, int count, const Grid3<float>& grid, Corners& corners) {
  const std::int32_t up = static_cast<std::int32_t>(grid.stride(1)), back = static_cast<std::int32_t>(grid.stride(2));
  for (int n = 0; n < count; ++n)
    corners.first[n] = along[0]->cell[n] + along[1]->cell[n] * up + along[2]->cell[n] * back;
}

/// Plain loads: cheaper here than the gathers of wide vectors, and two values each. Places in order of their rows come
/// to the row after these next, which is asked for.
inline void loadPairs(const Grid3<float>& grid, int count, Corners& corners) {
  const std::int64_t up = grid.stride(1), back = grid.stride(2);
  for (int n = 0; n < count; ++n) {
    const float* at = grid.values.data() + corners.first[n];
    fetchToRead(back + 2 * up, at);
    std::memcpy(corners.pair[0] + 2 * n, at, 2 * sizeof(float));
    std::memcpy(corners.pair[1] + 2 * n, at + up, 2 * sizeof(float));
    std::memcpy(corners.pair[2] + 2 * n, at + back, 2 * sizeof(float));
    std::memcpy(corners.pair[3] + 2 * n, at + back + up, 2 * sizeof(float));
  }
}

inline void mix(const PlaceCells& along, const Corners& corners, int count, float* values) {
  for (int n = 0; n < count; ++n) {
    const float a = along[0]->share[n], b = along[1]->share[n], c = along[2]->share[n];
    const auto line = [&](const float* pair) { return pair[2 * n] + (pair[2 * n + 1] - pair[2 * n]) * a; };
    const float p = line(corners.pair[0]), q = line(corners.pair[1]);
    const float r = line(corners.pair[2]), s = line(corners.pair[3]);
    const float near = p + (q - p) * b, far = r + (s - r) * b;
    values[n] = near + (far - near) * c;
  }
}

/// Grids with cells between samples, the numbers of which need no more than 31 bits.
bool hasCells(const Grid3<float>& grid) {
  return std::min({grid.size.x, grid.size.y, grid.size.z}) >= 2 &&
         grid.values.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
}

void interpolateEach(const Grid3<float>& grid, const PlaceBlock& places, int count, float* values) {
  for (int n = 0; n < count; ++n)
    values[n] = interpolate(grid, Vec3d(places.along[0][n], places.along[1][n], places.along[2][n]));
}

inline void interpolateIn(const PlaceCells& along, const Grid3<float>& grid, int count, float* values) {
  Corners corners;
  findCorners(along, count, grid, corners);
  loadPairs(grid, count, corners);
  mix(along, corners, count, values);
}

}  // namespace

void interpolateMany(const Grid3<float>& grid, const PlaceBlock& places, int count, float* values) {
  if (!hasCells(grid)) return interpolateEach(grid, places, count, values);
  AxisCells cells[3];
  runWide([&] {
    for (int axis = 0; axis < 3; ++axis) findCells(places.along[axis], count, axis, grid, cells[axis]);
    interpolateIn({&cells[0], &cells[1], &cells[2]}, grid, count, values);
  });
}

void interpolateMany(const MacVelocity& velocity, const PlaceBlock& places, int count, WindBlock& wind) {
  if (!hasCells(velocity.u) || !hasCells(velocity.v) || !hasCells(velocity.w)) {
    for (int axis = 0; axis < 3; ++axis) interpolateMany(velocity.component(axis), places, count, wind.along[axis]);
    return;
  }
  AxisCells own[3], other[3];  // along each axis: among the samples of its own component, and of the two others
  runWide([&] {
    for (int axis = 0; axis < 3; ++axis) {
      findCells(places.along[axis], count, axis, velocity.component(axis), own[axis]);
      findCells(places.along[axis], count, axis, velocity.component((axis + 1) % 3), other[axis]);
    }
    interpolateIn({&own[0], &other[1], &other[2]}, velocity.u, count, wind.along[0]);
    interpolateIn({&other[0], &own[1], &other[2]}, velocity.v, count, wind.along[1]);
    interpolateIn({&other[0], &other[1], &own[2]}, velocity.w, count, wind.along[2]);
  });
}

void interpolateMany(const Grid3<float>& grid, std::span<const Vec3d> places, float* values) {
  PlaceBlock block;
  for (std::size_t begin = 0; begin < places.size(); begin += PlaceBlock::most) {
    const int count = static_cast<int>(std::min<std::size_t>(PlaceBlock::most, places.size() - begin));
    for (int axis = 0; axis < 3; ++axis)
      for (int n = 0; n < count; ++n) block.along[axis][n] = places[begin + n][axis];
    interpolateMany(grid, block, count, values + begin);
  }
}

}  // namespace brisance
