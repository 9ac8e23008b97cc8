// Where one body cuts the lattice of cells: how much of each face lies in it, and which cell centres it parts. Places
// are in cells from the box's lower corner: cell i reaches from i to i + 1, its lower face lies at i.
#pragma once

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"
#include "mesh/moving_solid.h"

namespace brisance {

struct LatticeBox {
  Vec3i cells;
  Vec3d corner;     ///< [m]
  double cellSize;  ///< [m]

  explicit LatticeBox(const FluidSettings& s) : cells(s.cells), corner(s.corner), cellSize(s.cellSize) {}
  Vec3d inCells(const Vec3d& place) const { return (place - corner) / cellSize; }
  Vec3d centre(const Vec3i& cell) const { return Vec3d(cell) + Vec3d(.5, .5, .5); }
  std::int64_t cellIndex(const Vec3i& c) const {
    return c.x + static_cast<std::int64_t>(cells.x) * (c.y + static_cast<std::int64_t>(cells.y) * c.z);
  }
  /// In the grid of the velocity component along `axis`; `place[axis]` counts faces.
  std::int64_t faceIndex(int axis, const Vec3i& place) const {
    const std::int64_t nx = cells.x + (axis == 0), ny = cells.y + (axis == 1);
    return place.x + nx * (place.y + ny * place.z);
  }
  bool contains(const Vec3i& c) const {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < cells.x && c.y < cells.y && c.z < cells.z;
  }
};

using Corners = std::array<Vec3d, 3>;

struct FaceCut {
  Vec3i face;            ///< face[axis] counts faces, the others cells
  double covered = 0;    ///< share of the face that lies in the body
  bool crossed = false;  ///< the segment between the centres of its two cells meets the body's surface
};

struct BodyCut {
  std::array<std::vector<FaceCut>, 3> faces;  ///< by axis, each face once, ascending
  std::vector<Vec3i> insideCentres;           ///< cells whose centre lies in the body, or on it; ascending, once each
  std::vector<Corners> triangles;             ///< in cells
};

/// `watertight`: the mesh bounds a solid. Else it is a skin: it covers nothing and has no inside, but crosses segments.
BodyCut cutLattice(const LatticeBox& box, const MovingSolid& solid, bool watertight);

}  // namespace brisance
