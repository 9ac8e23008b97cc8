// A flat pane's outline and random points become triangles (section 3.3 of the thesis).
#pragma once

#include <variant>

#include "mesh/pane_points.h"
#include "mesh/triangle_mesh.h"

namespace brisance {

/// Triangles over points of the plane.
struct FlatMesh {
  std::vector<Vec2d> points;
  std::vector<Triangle> triangles;  ///< counter-clockwise
};

struct Trisection {};  ///< hull, then random interior points each split a triangle in three (thesis 3.3)
struct Delaunay {};    ///< dual of the Voronoi diagram, exact and unique (thesis 3.3)
using Triangulation = std::variant<Trisection, Delaunay>;

/// Triangulates the convex hull of the points; every point is used, collinear border points included.
FlatMesh triangulate(const std::vector<Vec2d>& points, const Triangulation& method, std::uint64_t seed);

/// Triangulates what the border encloses: all its edges are edges of triangles, and of two Delaunay triangles on both
/// sides of any other edge no circle holds the other's far corner. Points outside the border are not used. Throws
/// InputError where points on the lattice lie on one another's border edges, or the border crosses itself.
FlatMesh triangulatePane(const PanePoints& pane, const Triangulation& method, std::uint64_t seed);

}  // namespace brisance
