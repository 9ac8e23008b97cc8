// A closed mesh broken into solid pieces.
#pragma once

#include <functional>

#include "fracture/fracture.h"
#include "fracture/fracture_graph.h"

namespace brisance {

/// Divides a graph of small cells into so many connected parts.
using CellPartitioner = std::function<Partition(const FractureGraph&, int pieces)>;

struct SolidFracture {
  const CellPartitioner& partition;    ///< not asked where each piece is one cell
  std::vector<double> vertexStrength;  ///< per vertex of the mesh, above 0: faces are as strong as the surface near
                                       ///< them; empty: as large as they are
  bool hulls = false;                  ///< build Piece::hull too
};

/// Closed, oriented pieces, each in one part, whose volumes add up to the mesh's: cells of seeded points (Voronoi),
/// small cells fused as `partition` says, or the flat cells nearest to that. Exactly settings.pieces, unless the body
/// has more parts than that. Vertices of pieces are exact: piece.place + vertex is the same for both pieces that share
/// an inside face, whose triangles are the same with their sense reversed. Inside faces have the material "inside".
/// Throws InputError if the mesh is not closed and oriented, or crosses itself in a way that leaves a piece open.
FracturedBody fractureSolid(const TriangleMesh& mesh, const FractureSettings& settings, const SolidFracture& how);

}  // namespace brisance
