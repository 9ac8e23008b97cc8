// The least convex solid around points.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Closed and oriented, of the points that it needs alone. Qhull joggles its input, so many points of one plane leave
/// sliver facets whose normals mean nothing: convex by volume (points stand out from a facet by less than 1e-10 of the
/// cube of the extent), not by every facet's plane. Points of one plane have a closed hull without volume; fewer than
/// four points have their box; points that are all one have none. Any thread may call it.
TriangleMesh convexHull(const std::vector<Vec3d>& points);

}  // namespace brisance
