// A closed surface from a function of space, whatever its shape.
#pragma once

#include "assets/implicit_solid.h"
#include "mesh/triangle_mesh.h"

namespace brisance::samples {

/// The surface of `solid` inside `box`, which it must not touch, by marching tetrahedra (Doi & Koide 1991): each cell
/// of a lattice of `step` [m] is six tetrahedra about its diagonal (Kuhn 1960). Always closed, oriented and manifold,
/// also where parts of the surface come closer than a cell; its triangles are of any shape.
TriangleMesh marchingTetrahedra(const Implicit& solid, const Box3& box, double step);

}  // namespace brisance::samples
