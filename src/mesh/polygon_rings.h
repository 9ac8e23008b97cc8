// The border of a flat polygon as rings of corners, holes joined to what surrounds them.
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// A corner of the border; corners that share a point are several.
struct RingCorner {
  std::uint32_t point = 0;
  std::uint32_t before = 0, after = 0;  ///< corners
};

struct PolygonRings {
  std::vector<RingCorner> corners;
  std::vector<std::uint32_t> starts;  ///< one corner per ring, counter-clockwise and without holes
};

/// A hole is joined by a bridge, there and back, from its leftmost corner to one that sees it.
PolygonRings polygonRings(const std::vector<Vec2d>& points, const std::vector<std::vector<std::uint32_t>>& loops);

}  // namespace brisance
