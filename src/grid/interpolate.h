// Values between the samples of a grid.
#pragma once

#include <algorithm>

#include "grid/grid3.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// The numbers that weigh values of a type: those of its components.
template <class T>
struct WeightOf {
  using type = T;
};
template <class S>
struct WeightOf<Vec3<S>> {
  using type = S;
};

/// Trilinear value at a place; beyond the samples the nearest ones hold.
template <class T>
T interpolate(const Grid3<T>& grid, const Vec3d& place) {
  const Vec3d p = (place - grid.origin) / grid.cellSize;
  using Weight = typename WeightOf<T>::type;
  const auto split = [](double x, int n, int& i, Weight& f) {
    x = std::clamp(x, 0.0, n - 1.0);
    i = std::min(static_cast<int>(x), std::max(0, n - 2));
    f = static_cast<Weight>(x - i);
  };
  int i, j, k;
  Weight a, b, c;
  split(p.x, grid.size.x, i, a);
  split(p.y, grid.size.y, j, b);
  split(p.z, grid.size.z, k, c);
  const std::int64_t sx = grid.size.x > 1 ? 1 : 0, sy = grid.size.y > 1 ? grid.stride(1) : 0,
                     sz = grid.size.z > 1 ? grid.stride(2) : 0;
  const T* g = grid.values.data() + grid.index(i, j, k);
  const auto line = [&](std::int64_t at) { return g[at] + (g[at + sx] - g[at]) * a; };
  const auto plane = [&](std::int64_t at) { return line(at) + (line(at + sy) - line(at)) * b; };
  return plane(0) + (plane(sz) - plane(0)) * c;
}

/// Each component from its own samples.
inline Vec3d interpolate(const MacVelocity& velocity, const Vec3d& place) {
  return {interpolate(velocity.u, place), interpolate(velocity.v, place), interpolate(velocity.w, place)};
}

}  // namespace brisance
