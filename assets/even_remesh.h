// A closed surface in even triangles.
#pragma once

#include "assets/implicit_solid.h"
#include "mesh/triangle_mesh.h"

namespace brisance::samples {

/// Wanted edge length at a place, relative to that elsewhere: below 1 where there are fine details.
using EdgeSize = std::function<double(const Vec3d&)>;

/// The surface of `solid`, which `mesh` (closed, manifold) lies near, in exactly `triangles` triangles (an even number)
/// whose edges are as long as `size` says, as nearly as that goes. Isotropic remeshing (Botsch & Kobbelt 2004, "A
/// remeshing approach to multiresolution modeling"): long edges are split, short ones collapse, flips even out the
/// numbers of neighbours, vertices move to the middle of theirs and back onto the surface. Stays closed and manifold.
TriangleMesh evenRemesh(const TriangleMesh& mesh, const Implicit& solid, const EdgeSize& size, std::size_t triangles);

/// How uneven the edges are: standard deviation of (length / size) over its mean.
double edgeUnevenness(const TriangleMesh& mesh, const EdgeSize& size);

}  // namespace brisance::samples
