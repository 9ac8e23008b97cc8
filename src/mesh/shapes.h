// Spheres, boxes and rectangles as meshes with u v, as appendix A.1.3 of the thesis maps them.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Closed sphere about the origin from a latitude-longitude net; normals and uvs set (seam vertices doubled only in
/// uv-carrying meshes, so `isClosed` wants the welded form: withUv = false).
TriangleMesh sphereMesh(double radius, int segments = 32, bool withUv = true);
/// Closed box about the origin; with uvs each face has vertices of its own and u, v from 0 to 1 times `uvRepeat`.
TriangleMesh boxMesh(const Vec3d& size, bool withUv = true, const Vec2d& uvRepeat = {1, 1});
/// Width x height in the x-y plane about the origin, facing +z.
TriangleMesh rectangleMesh(double width, double height, const Vec2d& uvRepeat = {1, 1});

}  // namespace brisance
