// The least convex solid around points.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Closed and oriented, of the points that it needs alone. Points of one plane, line or place have a hull as thick as
/// rounding (Qhull joggles its input): a closed mesh of some volume still, unless all points are one, whose hull is
/// empty. Any thread may call it.
TriangleMesh convexHull(const std::vector<Vec3d>& points);

}  // namespace brisance
