// A flat set of triangles becomes a solid (section 3.3, sides oriented outward as the errata ask).
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// Closed, oriented solid between z = -thickness/2 and +thickness/2 over the given triangles of `flat` [m].
/// Texture coordinates go from 0 to 1 over the box around all of `flat`, on the front as on the back, so that a picture
/// runs on from piece to piece. Vertices that no triangle uses are dropped; a vertex where two fans of triangles touch
/// alone is split.
TriangleMesh extrude(const FlatMesh& flat, const std::vector<std::uint32_t>& triangles, double thickness);

}  // namespace brisance
