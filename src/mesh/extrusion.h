// A flat set of triangles becomes a solid (section 3.3, sides oriented outward as the errata ask).
#pragma once

#include "mesh/triangulation.h"

namespace brisance {

/// Closed, oriented solid between z = -thickness/2 and +thickness/2 over the given triangles of `flat` [m].
/// Vertices that no triangle uses are dropped; a vertex where two fans of triangles touch alone is split.
TriangleMesh extrude(const FlatMesh& flat, const std::vector<std::uint32_t>& triangles, double thickness);

}  // namespace brisance
