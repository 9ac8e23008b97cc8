// The methods behind triangulate(): on lattice points, where they are exact.
#pragma once

#include "mesh/lattice_points.h"
#include "mesh/triangulation.h"

namespace brisance {

/// Corners of the convex hull, counter-clockwise, without points inside its edges. Fewer than three if all lie on a
/// line.
std::vector<std::uint32_t> hullCorners(const LatticePoints& points);

/// Both want points that do not all lie on one line.
std::vector<Triangle> delaunay(const LatticePoints& points);
/// What the border encloses, counter-clockwise, first divided by a random point that sees all of it. Where there is
/// none, a border along the hull is divided from its first corner, and any other by its own Delaunay triangulation.
std::vector<Triangle> trisect(const LatticePoints& points, const std::vector<std::uint32_t>& border,
                              std::uint64_t seed);

/// Turns a triangulation of the hull into one of what the border encloses: its edges are brought in by flips, edges
/// inside flipped to Delaunay again, triangles outside left out.
std::vector<Triangle> withinBorder(std::vector<Triangle> hullTriangles, const std::vector<LatticePoint>& nodes,
                                   const std::vector<std::uint32_t>& border);

}  // namespace brisance
