// Which seeds are neighbours in space: their regular triangulation, exact, dual to the cells of a power diagram.
#pragma once

#include <vector>

#include "fracture/cell_lattice.h"

namespace brisance {

/// A point belongs to the seed of least |point - place|^2 - weight. All weights equal: Voronoi cells.
struct WeightedSeed {
  Vec3l place;              ///< at most 2^20 from the origin along each axis [seed steps]
  std::int64_t weight = 0;  ///< at most 2^38 either way [seed steps^2]
};

constexpr std::uint32_t noTetrahedron = 0xFFFFFFFFu;

struct Tetrahedron {
  std::array<std::uint32_t, 4> seeds;       ///< the fourth on the side that the first three, counter-clockwise, face
  std::array<std::uint32_t, 4> neighbours;  ///< across the face opposite each seed
};

/// Six times the volume: above 0 where d lies on the side from which a, b, c turn clockwise, as x, y, z of the origin.
Int128 orientation(const Vec3l& a, const Vec3l& b, const Vec3l& c, const Vec3l& d);

/// Incremental (Bowyer 1981, Watson 1981; with weights Edelsbrunner & Shah 1996). The last four seeds enclose all
/// others. Seeds hidden by heavier ones are in no tetrahedron. Throws Coincidence where the answer is not unique.
std::vector<Tetrahedron> powerTriangulation(const std::vector<WeightedSeed>& seeds);

}  // namespace brisance
