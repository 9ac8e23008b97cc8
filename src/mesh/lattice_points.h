// Points of the plane on an integer lattice, where questions of side and circle have exact answers.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math.h"

namespace brisance {

struct LatticePoint {
  std::int32_t x = 0, y = 0;  ///< from 0 to 2^30: a product of two differences fits 64 bits, of four 128
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;  // NOLINT(modernize-use-nullptr)
};

/// Twice the signed area of a triangle: above 0 where a, b, c turn counter-clockwise, 0 on one line.
inline std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  const std::int64_t abX = b.x - a.x, abY = b.y - a.y, acX = c.x - a.x, acY = c.y - a.y;
  return abX * acY - abY * acX;
}

__extension__ using Int128 = __int128;

/// Above 0 where d lies inside the circle through a, b, c (counter-clockwise), 0 where it lies on it: only the sign is
/// meant, and it is exact. Floating point decides where its error, below 3 roundings of each product, cannot matter.
inline double circleSide(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const std::int64_t a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const std::int64_t bc = bx * cy - by * cx, ca = cx * ay - cy * ax, ab = ax * by - ay * bx;
  const double inA = static_cast<double>(a2) * static_cast<double>(bc),
               inB = static_cast<double>(b2) * static_cast<double>(ca),
               inC = static_cast<double>(c2) * static_cast<double>(ab);
  constexpr double errorShare = 6 * 0x1p-53;
  const double sum = inA + inB + inC;
  if (std::abs(sum) > errorShare * (std::abs(inA) + std::abs(inB) + std::abs(inC))) return sum;
  const Int128 exact = Int128{a2} * bc + Int128{b2} * ca + Int128{c2} * ab;
  return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

/// Whether d lies strictly inside the circle through a, b, c (counter-clockwise).
inline bool insideCircle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  return circleSide(a, b, c, d) > 0;
}

/// The same with points on the circle told apart, so that every set of points has one Delaunay triangulation: as if
/// the paraboloid over the lexicographically greatest of the four were raised by nearly nothing (Edelsbrunner & Muecke
/// 1990). No tie where two of the four are one point.
inline bool insideCircleOrTie(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                              const LatticePoint& d) {
  const double side = circleSide(a, b, c, d);
  if (side != 0) return side > 0;
  const LatticePoint& greatest = std::max(std::max(a, b), std::max(c, d));
  if (d == a || d == b || d == c || greatest == d) return false;
  if (greatest == a) return orientation(d, b, c) > 0;
  return greatest == b ? orientation(d, c, a) > 0 : orientation(d, a, b) > 0;
}

/// Points moved to the nearest node of a lattice whose step is a power of two, at most 2^-29 of their extent.
struct LatticePoints {
  std::vector<LatticePoint> nodes;
  std::vector<Vec2d> points;            ///< the nodes' places [m]
  std::vector<std::uint32_t> distinct;  ///< the first point on each node, in lexicographic order of the nodes
};
LatticePoints snapToLattice(const std::vector<Vec2d>& points);

}  // namespace brisance
