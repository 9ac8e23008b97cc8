// Where two convex solids are nearest to each other: Bullet's GJK, and its EPA where they overlap.
#pragma once

#include <optional>
#include <span>

#include "base/math.h"

namespace brisance {

struct ClosestPoints {
  Vec3d normal;         ///< from a to b, of length one
  Vec3d onA, onB;       ///< [m]
  double distance = 0;  ///< [m] along the normal; below zero: how deep they overlap
};

/// Of the hulls of points in the same coordinates; nothing where no answer was found. Keeps nothing between calls; any
/// thread may call it.
std::optional<ClosestPoints> closestPoints(std::span<const Vec3d> a, std::span<const Vec3d> b);

}  // namespace brisance
