#include "fracture/distinct_places.h"

#include <bit>

#include "fracture/solid_surface.h"

namespace brisance {
namespace {

/// Neighbours of the origin in a cube of (2 reach + 1)^3, by number.
Vec3d cubeOffset(int number, int reach) {
  const int side = 2 * reach + 1;
  const int x = number % side, y = number / side % side, z = number / (side * side);
  return {static_cast<double>(x - reach), static_cast<double>(y - reach), static_cast<double>(z - reach)};
}

}  // namespace

std::size_t DistinctPlaces::Hash::operator()(const Vec3d& p) const {
  std::uint64_t hash = 0;
  for (const double x : {p.x, p.y, p.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15u;  // + 0.0: one zero only
    hash ^= hash >> 32;
  }
  return hash;
}

Vec3d DistinctPlaces::take(const Vec3d& place) {
  const Vec3d wanted = onSteps(place, step_);
  if (taken_.insert(wanted).second) return wanted;
  for (int reach = 1;; ++reach)
    for (int n = 0; n < (2 * reach + 1) * (2 * reach + 1) * (2 * reach + 1); ++n) {
      const Vec3d beside = wanted + cubeOffset(n, reach) * step_;
      if (taken_.insert(beside).second) return beside;
    }
}

}  // namespace brisance
