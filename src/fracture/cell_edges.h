// The edges of cells, and which stretches of them lie inside a body.
#pragma once

#include "fracture/surface_cutting.h"

namespace brisance {

/// Where three cells meet: a line from one tetrahedron's meeting point to another's.
struct CellEdge {
  std::array<std::uint32_t, 3> cells;  ///< rising: a, b, c; the edge runs along (b - a) x (c - a) of their seeds
  std::uint32_t from, to;              ///< tetrahedra
  std::uint32_t first = 0, count = 0;  ///< its crossings with the surface, in order
};

struct EdgeCrossing {
  std::uint32_t point;  ///< number in CutSurface::points
  int step;             ///< of the winding number, along the edge: +1 where it enters the body
};

/// How often the surface winds about a point is 1 inside a body and 0 outside; for a surface that crosses itself also
/// other numbers.
struct CellEdges {
  std::vector<CellEdge> edges;                       ///< rising by cells
  std::vector<std::array<std::uint32_t, 4>> edgeOf;  ///< per tetrahedron and face; noEdge where a ghost is involved
  std::vector<EdgeCrossing> crossings;
  std::vector<int> winding;  ///< at the tetrahedra's meeting points
  int deepestWinding = 1;    ///< on edges; above 1 where the surface crosses itself
  static constexpr std::uint32_t noEdge = 0xFFFFFFFFu;
};

CellEdges cellEdges(const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram);

}  // namespace brisance
