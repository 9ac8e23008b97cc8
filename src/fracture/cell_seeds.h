// Points that cells grow around: uniform, or crowding towards an impact.
#pragma once

#include <span>
#include <vector>

#include "fracture/fracture_settings.h"

namespace brisance {

/// The density law: how many cells a place has, relative to one at the distance `reach` [m] from the impact.
/// (0.1 + distance / reach)^-crowding: a hundred times as many at the impact as far from it for the default of 2, so
/// cells of a tenth of the width on a surface. 1 everywhere without an impact.
double cellDensity(const Voronoi& cells, const Vec3d& place, double reach);

/// `count` different ones of the places (at most all of them), seeded: drawn by density times size (`sizes` may be
/// empty: all one), each the best separated of several draws (Mitchell 1991) with distance measured against the local
/// spacing of cells.
std::vector<std::uint32_t> crowdedPoints(std::span<const Vec3d> places, std::span<const double> sizes, int count,
                                         const Voronoi& cells, std::uint64_t seed);

}  // namespace brisance
