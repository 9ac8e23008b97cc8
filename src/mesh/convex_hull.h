// The least convex solid around points.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Closed and oriented, of the points that it needs alone; convex to about 1e-13 of their extent, since Qhull joggles
/// its input, so many points of one plane may leave sliver facets. Points of one plane have a closed hull without
/// volume; fewer than four points have their box; points that are all one have none. Any thread may call it.
TriangleMesh convexHull(const std::vector<Vec3d>& points);

}  // namespace brisance
