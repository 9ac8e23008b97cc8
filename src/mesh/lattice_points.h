// Points of the plane on an integer lattice, where questions of side and circle have exact answers.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math.h"

namespace brisance {

struct LatticePoint {
  std::int32_t x = 0, y = 0;  ///< from 0 to 2^30: a product of two differences fits 64 bits, of four 128
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// Twice the signed area of a triangle: above 0 where a, b, c turn counter-clockwise, 0 on one line.
inline std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  const std::int64_t abX = b.x - a.x, abY = b.y - a.y, acX = c.x - a.x, acY = c.y - a.y;
  return abX * acY - abY * acX;
}

__extension__ using Int128 = __int128;

/// Whether d lies strictly inside the circle through a, b, c (counter-clockwise).
inline bool insideCircle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const Int128 a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return a2 * (bx * cy - by * cx) + b2 * (cx * ay - cy * ax) + c2 * (ax * by - ay * bx) > 0;
}

/// Points moved to the nearest node of a lattice whose step is a power of two, at most 2^-29 of their extent.
struct LatticePoints {
  std::vector<LatticePoint> nodes;
  std::vector<Vec2d> points;            ///< the nodes' places [m]
  std::vector<std::uint32_t> distinct;  ///< the first point on each node, in lexicographic order of the nodes
};
LatticePoints snapToLattice(const std::vector<Vec2d>& points);

}  // namespace brisance
