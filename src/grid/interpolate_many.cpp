#include "grid/interpolate_many.h"

#include <cstring>

#include "base/vector_path.h"
#include "grid/interpolate.h"

namespace brisance {

namespace {

constexpr int blockPlaces = PlaceBlock::most;  // whose corners stay in the nearest cache

/// For some places: the first corner of their cells, how far they are into them, and the values at the corners, in
/// pairs along x.
struct Corners {
  alignas(64) std::int64_t first[blockPlaces];
  alignas(64) float share[3][blockPlaces];
  alignas(64) float pair[4][2 * blockPlaces];
};

/// Cell and share along one axis; `cell` is counted in steps of `stride`.
inline void addAxis(const double* places, int count, int axis, const Grid3<float>& grid, Corners& corners) {
  const double origin = grid.origin[axis], last = grid.size[axis] - 1.0, inverse = 1 / grid.cellSize;
  const int lastCell = grid.size[axis] - 2;
  const std::int64_t stride = grid.stride(axis);
  float* share = corners.share[axis];
  for (int n = 0; n < count; ++n) {
    const double x = (places[n] - origin) * inverse;
    const double inside = std::min(x > 0 ? x : 0.0, last);
    const int cell = std::min(static_cast<int>(inside), lastCell);
    share[n] = static_cast<float>(inside - cell);
    corners.first[n] += cell * stride;
  }
}

/// Plain loads: cheaper here than the gathers of wide vectors, and two values each.
inline void loadPairs(const Grid3<float>& grid, int count, Corners& corners) {
  const std::int64_t up = grid.stride(1), back = grid.stride(2);
  for (int n = 0; n < count; ++n) {
    const float* at = grid.values.data() + corners.first[n];
    std::memcpy(corners.pair[0] + 2 * n, at, 2 * sizeof(float));
    std::memcpy(corners.pair[1] + 2 * n, at + up, 2 * sizeof(float));
    std::memcpy(corners.pair[2] + 2 * n, at + back, 2 * sizeof(float));
    std::memcpy(corners.pair[3] + 2 * n, at + back + up, 2 * sizeof(float));
  }
}

inline void mix(const Corners& corners, int count, float* values) {
  for (int n = 0; n < count; ++n) {
    const float a = corners.share[0][n], b = corners.share[1][n], c = corners.share[2][n];
    const auto line = [&](const float* pair) { return pair[2 * n] + (pair[2 * n + 1] - pair[2 * n]) * a; };
    const float p = line(corners.pair[0]), q = line(corners.pair[1]);
    const float r = line(corners.pair[2]), s = line(corners.pair[3]);
    const float near = p + (q - p) * b, far = r + (s - r) * b;
    values[n] = near + (far - near) * c;
  }
}

}  // namespace

void interpolateMany(const Grid3<float>& grid, const PlaceBlock& places, int count, float* values) {
  if (std::min({grid.size.x, grid.size.y, grid.size.z}) < 2) {
    for (int n = 0; n < count; ++n)
      values[n] = interpolate(grid, Vec3d(places.along[0][n], places.along[1][n], places.along[2][n]));
    return;
  }
  Corners corners;
  runWide([&] {
    std::fill_n(corners.first, count, 0);
    for (int axis = 0; axis < 3; ++axis) addAxis(places.along[axis], count, axis, grid, corners);
    loadPairs(grid, count, corners);
    mix(corners, count, values);
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
