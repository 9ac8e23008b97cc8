// The flat faces between cells inside a body.
#pragma once

#include "fracture/cell_edges.h"

namespace brisance {

/// A connected part of the face between two cells, or several that were filled at once.
struct Cap {
  std::uint32_t lowCell, highCell;
  std::uint32_t first, count;  ///< its triangles in CellCaps::triangles, facing the high cell
};

/// A body taken apart into cells. Vertices: those of the surface, its cut points, then meeting points of four cells.
struct CellComplex {
  SolidSurface surface;
  CellDiagram diagram;
  CutSurface cut;
  std::vector<std::uint32_t> meetings;  ///< tetrahedra whose meeting points are inside the body
  std::vector<Vec3d> places;            ///< [m] of all vertices, no two alike, multiples of surface.step
  std::vector<Cap> caps;
  std::vector<Triangle> capTriangles;
  bool overlaps = false;  ///< the surface crosses itself, where it was noticed

  std::uint32_t firstPoint() const { return static_cast<std::uint32_t>(surface.places.size()); }
  std::uint32_t firstMeeting() const { return firstPoint() + static_cast<std::uint32_t>(cut.points.size()); }
};

/// Cuts along all faces between the cells of seeds. `seeds` are places [m] with weights [m2] (empty: all equal).
/// `shake` tries another general position. Throws Coincidence where this one is not general.
CellComplex cellComplex(const SolidSurface& surface, const std::vector<Vec3d>& seeds,
                        const std::vector<double>& weights, std::uint64_t shake);

}  // namespace brisance
