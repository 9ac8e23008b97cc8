// A flat pane's outline and random points become triangles (section 3.3 of the thesis).
#pragma once

#include <variant>

#include "base/random.h"
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

/// The corners of a width x height rectangle centred on the origin, then `count` points inside it, uniform and seeded.
/// `borderCount` further points lie on the border, so that shards' outer edges vary in length.
std::vector<Vec2d> panePoints(double width, double height, int count, int borderCount, std::uint64_t seed);

/// Triangulates the convex hull of the points; every point is used, collinear border points included.
FlatMesh triangulate(const std::vector<Vec2d>& points, const Triangulation& method, std::uint64_t seed);

}  // namespace brisance
