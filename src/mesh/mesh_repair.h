// The mesh doctor: makes of a mesh from anywhere the surface of a solid, says what it did, and refuses what it cannot.
#pragma once

#include "mesh/mesh_report.h"

namespace brisance {

constexpr std::size_t mostHoleEdges = 256;  ///< closing a hole takes time as the cube of its edges

struct RepairSettings {
  double weldDistance = 0;        ///< [m] vertices this close become one; 0: those at exactly the same place
  std::size_t fillHolesUpTo = 0;  ///< edges around a hole that is closed, up to mostHoleEdges; 0: none is
};

/// Texture seams stay: a vertex of `mesh` is a place with one normal and u v, and several may lie on one vertex of the
/// surface. Two vertices of the surface may lie at one place: there fans of triangles touch that do not belong
/// together.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> sourceTriangle;   ///< per triangle, its number in the input; noTriangle: closes a hole
  std::vector<std::uint32_t> surfaceVertexOf;  ///< per vertex of `mesh`
  std::size_t surfaceVertices = 0;
  std::vector<std::string> done;  ///< one line for each kind of repair, with its count and first place
  Defect openEdges;               ///< what is left: edges of one triangle,
  Defect tangledEdges;            ///< of more than two that cannot be told apart,
  Defect twistedEdges;            ///< and such that no way of turning the triangles makes agree
};

/// In this order: welds; drops triangles that come back to a corner, and duplicates (copies leave one, opposite copies
/// none); turns the edge under a triangle of no area, which so finds one; closes small holes where asked; turns
/// triangles to agree with their neighbours, as most of them do; takes apart edges of several sheets and pinched
/// vertices; turns closed parts outward, and inward where they lie inside another. A sound mesh stays as it is.
RepairedMesh repair(const TriangleMesh& mesh, const RepairSettings& settings = {});

/// The surface alone: vertices of the surface and triangles, numbered as in `mesh`.
TriangleMesh bareSurface(const RepairedMesh& repaired);

/// Throws DamagedFile("FILE: what keeps this from being a solid, the first place, what would help") unless the surface
/// is closed and has a volume.
void requireSolid(const RepairedMesh& repaired, const std::string& file);

}  // namespace brisance
