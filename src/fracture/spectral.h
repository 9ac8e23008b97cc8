// Pieces by spectral bisection: a body breaks where it is weakest (thesis 4.2.2, Algorithm 6).
#pragma once

#include "fracture/fiedler.h"
#include "fracture/fracture_settings.h"

namespace brisance {

struct SpectralPartition {
  Partition partition;              ///< of the triangles
  std::vector<double> eigenvalues;  ///< the smallest three of the whole mesh, as far as they were needed: 0 once for
                                    ///< each part that nothing joins, then lambda_2 and lambda_3
};

/// Cuts the surface along its own triangles into exactly `pieces` connected parts (a mesh of more components than that
/// keeps its components). Each cut follows the sign of the Fiedler vector of the part's vertex graph: a triangle goes
/// with two or three of its corners. Stray islands are handed to the other side; where all triangles fall on one side,
/// the part is split at the median. The next part to be cut is always the weakest, that of the smallest lambda_2.
/// With Curvature::parts, so many parts are cut like that and then broken further by partitionBreadthFirst.
/// Throws InputError if there are fewer triangles than pieces.
SpectralPartition partitionSurface(const TriangleMesh& mesh, const Curvature& curvature, int pieces,
                                   const EigenTolerance& tolerance = {});
SpectralPartition partitionSurface(const TriangleMesh& mesh, const Spectral& spectral, int pieces,
                                   const EigenTolerance& tolerance = {});

/// The same for the nodes of any graph, such as the cells of a solid.
Partition partitionSpectral(const FractureGraph& graph, int pieces, const EigenTolerance& tolerance = {});

}  // namespace brisance
