// Flat polygons, with holes, become triangles.
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// Triangles over the points of the loops alone: outer loops run counter-clockwise, holes clockwise. Whatever the
/// points' places, each side of a loop is a side of one triangle in the same direction, and every other side of a
/// triangle is shared with one that runs against it. Where the loops do not cross, the triangles do not overlap; sides
/// are exchanged while that makes triangles rounder, so that none is flatter than it has to be.
std::vector<Triangle> fillPolygon(const std::vector<Vec2d>& points,
                                  const std::vector<std::vector<std::uint32_t>>& loops);

}  // namespace brisance
