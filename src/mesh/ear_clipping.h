// Triangles cut one by one from the corners of a polygon (Meisters 1975), holes joined to their surroundings first
// (Held 2001, Eberly 2002).
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// Twice the signed area of a triangle.
inline double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// As fillPolygon, before triangles are made rounder.
std::vector<Triangle> clipEars(const std::vector<Vec2d>& points, const std::vector<std::vector<std::uint32_t>>& loops);

}  // namespace brisance
