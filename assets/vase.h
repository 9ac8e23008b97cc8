// A vase with u v, for pictures of textured meshes.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance::assets {

/// A closed surface of revolution about the y axis, 1 m high on y = 0, with normals and u v (u around, v up the
/// outside), of about `triangles` triangles.
TriangleMesh vase(long triangles);

}  // namespace brisance::assets
