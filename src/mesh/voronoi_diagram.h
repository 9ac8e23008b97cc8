// The Voronoi diagram of points, dual of their Delaunay triangulation (Figure 3.5 of the thesis).
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// Points equally near to two sites, and nearer to no other.
struct VoronoiEdge {
  std::uint32_t a = 0, b = 0;  ///< sites, `a` to the left seen from `from`
  Vec2d from, to;              ///< [m]
};

/// All of it within an outline.
struct VoronoiDiagram {
  std::vector<Vec2d> sites;               ///< [m] on the lattice of triangulations
  std::vector<std::vector<Vec2d>> cells;  ///< of each site, counter-clockwise; empty for a site given before. In a
                                          ///< concave outline parts of one cell are joined by lines along cell borders
  std::vector<VoronoiEdge> edges;         ///< one for each stretch inside
};

/// Clipped to a simple polygon, given counter-clockwise. For drawing: it takes sites x corners. Throws InputError where
/// all sites lie on one line.
VoronoiDiagram voronoiDiagram(const std::vector<Vec2d>& sites, const std::vector<Vec2d>& outline);

}  // namespace brisance
