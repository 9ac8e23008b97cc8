// The bare surface of a closed mesh: every vertex has one fan of triangles and a place of its own.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

constexpr std::uint32_t noVertex = 0xFFFFFFFFu;

struct SolidSurface {
  std::vector<Vec3d> places;         ///< [m] multiples of `step`, no two equal
  std::vector<Triangle> triangles;   ///< closed, oriented
  std::vector<Triangle> corners;     ///< the mesh's own vertices at the same corners
  std::vector<std::uint32_t> faces;  ///< the mesh's triangle that each was
  double step = 0;                   ///< [m] a power of two; differences of two multiples in the body's box are exact
};

/// Nearest multiple of the step, component by component.
Vec3d onSteps(const Vec3d& place, double step);

/// Vertices doubled for their normals or uvs are one again (exactly equal places), vertices where several fans of
/// triangles touch are split and moved apart by a few steps (4e-16 of the largest coordinate), triangles that name a
/// place twice are dropped. Throws InputError if an edge is not used equally often in both directions.
SolidSurface solidSurface(const TriangleMesh& mesh);

}  // namespace brisance
