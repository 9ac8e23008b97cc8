// A convex polyhedron by its corners and flat faces.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

struct ConvexFace {
  Vec3d normal;                        ///< outwards, of length one
  std::vector<std::uint32_t> corners;  ///< numbers of points, counter-clockwise seen from outside
};

struct ConvexSolid {
  std::vector<Vec3d> points;      ///< [m] the corners, no others
  std::vector<ConvexFace> faces;  ///< triangles of one plane are one face
};

/// The hull of points. Points of one plane make a sheet with two faces; without an extent there are no faces.
ConvexSolid convexSolid(const std::vector<Vec3d>& points);
/// A triangle as a sheet, with the face that it shows and, if `twoSided`, the one on its back.
ConvexSolid triangleSheet(const Vec3d& a, const Vec3d& b, const Vec3d& c, bool twoSided);

/// Least extent along a face's normal [m]: how thick it is.
double thickness(const ConvexSolid& solid);
Box3 bounds(const ConvexSolid& solid);
/// Turned and moved, into a solid of the same corners and faces.
void place(const ConvexSolid& solid, const Pose& pose, ConvexSolid& placed);

}  // namespace brisance
