// A surface cut along the cells of a diagram: what lies whole in one cell, polygons, and the vertices of the cuts.
#pragma once

#include "fracture/clip_triangle.h"
#include "fracture/solid_surface.h"

namespace brisance {

/// A vertex by what meets there; triangles and cells on all sides of it name it alike.
struct CutPoint {
  enum Kind : std::uint32_t {
    corner,     ///< of = {vertex, 0, 0, 0}
    onEdge,     ///< of = {lower vertex, upper vertex, cells rising}
    inTriangle  ///< of = {triangle, three cells rising}
  };
  Kind kind = corner;
  std::array<std::uint32_t, 4> of{};
  friend auto operator<=>(const CutPoint&, const CutPoint&) = default;  // NOLINT(modernize-use-nullptr)
};

struct CutPolygon {
  std::uint32_t triangle, cell;
  std::uint32_t first, count;  ///< its vertices in CutSurface::corners, counter-clockwise from outside
};

/// A stretch of the border of the face between two cells, where the surface crosses it.
struct CapSegment {
  std::uint32_t lowCell, highCell;
  std::uint32_t from, to;  ///< the face, as seen from the high cell, lies to the left
  friend auto operator<=>(const CapSegment&, const CapSegment&) = default;  // NOLINT(modernize-use-nullptr)
};

struct CutSurface {
  std::vector<Vec3l> lattice;                 ///< vertices of the surface
  std::vector<std::uint32_t> cellOfVertex;    ///< of the surface
  std::vector<std::uint32_t> cellOfTriangle;  ///< noCell: cut
  std::vector<CutPoint> points;               ///< rising; their vertex numbers follow those of the surface
  std::vector<CutPolygon> polygons;           ///< of cut triangles
  std::vector<std::uint32_t> corners;
  std::vector<CapSegment> segments;  ///< rising
};

CutSurface cutSurface(const SolidSurface& surface, const CellDiagram& diagram, const CellLattice& lattice);

/// Shares of the corners (of an edge: lower, upper vertex; of a triangle: its three) that make up a cut point; their
/// sum is one.
Vec3d sharesOf(const CutPoint& point, const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram);

}  // namespace brisance
