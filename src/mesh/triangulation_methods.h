// The methods behind triangulate(): on lattice points, where they are exact.
#pragma once

#include "mesh/lattice_points.h"
#include "mesh/triangulation.h"

namespace brisance {

/// Corners of the convex hull, counter-clockwise, without points inside its edges. Fewer than three if all lie on a
/// line.
std::vector<std::uint32_t> hullCorners(const LatticePoints& points);

/// Both want points that do not all lie on one line.
std::vector<Triangle> trisect(const LatticePoints& points, std::uint64_t seed);
std::vector<Triangle> delaunay(const LatticePoints& points);

}  // namespace brisance
