// A mesh of several bodies, one by one.
#pragma once

#include "fracture/solid_surface.h"

namespace brisance {

/// Connected parts of the surface that bound a body, each with the cavities that it surrounds; in order of their first
/// triangles, with all that the mesh carries. They may overlap one another.
std::vector<TriangleMesh> separateBodies(const TriangleMesh& mesh, const SolidSurface& surface);

/// How many of `pieces` each body gets: at least one, the rest by volume.
std::vector<int> piecesOfBodies(const std::vector<TriangleMesh>& bodies, int pieces);

}  // namespace brisance
