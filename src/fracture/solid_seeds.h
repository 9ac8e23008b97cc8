// Seeds of cells inside a body.
#pragma once

#include "fracture/fracture_settings.h"
#include "fracture/solid_surface.h"

namespace brisance {

/// `count` places inside the body, well apart: uniform by volume, or crowding towards an impact (`crowdedPoints` among
/// many places drawn uniformly). Throws InputError if the surface encloses nothing.
std::vector<Vec3d> solidSeeds(const SolidSurface& surface, const Voronoi& cells, int count, std::uint64_t seed);

}  // namespace brisance
