// The connected parts of cells, and the graph of those that touch.
#pragma once

#include "fracture/cell_caps.h"
#include "fracture/fracture_graph.h"

namespace brisance {

/// Part of one cell that hangs together.
struct Atom {
  std::uint32_t cell = noCell;
  double volume = 0;  ///< [m3]
  Vec3d centroid;     ///< [m]
};

/// Where two atoms touch.
struct Contact {
  int a = 0, b = 0;  ///< a < b
  double area = 0;   ///< [m2]
  Vec3d normal;      ///< [m2] areas times normals, from a to b
  Vec3d place;       ///< [m] centroid
};

struct CellAtoms {
  std::vector<Atom> atoms;
  std::vector<int> ofTriangle;                    ///< of the surface; cut: -1
  std::vector<int> ofPolygon;                     ///< CutSurface::polygons
  std::vector<std::array<int, 2>> ofCapTriangle;  ///< on the low and the high cell's side
  std::vector<Contact> contacts;                  ///< rising by a, then b
};

CellAtoms cellAtoms(const CellComplex& complex);

/// Nodes are atoms, as large as their volumes; edges are as strong as the shared face's area, times the strength of the
/// surface nearby: the mean of `vertexStrength` (per vertex of the mesh, above 0; empty: all one) over the outside
/// triangles of both atoms. Deep inside it is the mean of all.
FractureGraph atomGraph(const CellComplex& complex, const CellAtoms& atoms, const std::vector<double>& vertexStrength);

}  // namespace brisance
