// The second eigenvector of a graph's Laplacian, which shows where the graph is weakest (Fiedler 1973).
#pragma once

#include "fracture/fracture_graph.h"

namespace brisance {

struct EigenTolerance {
  double residual = 1e-6;  ///< |L x - lambda x| <= residual * lambda |x|
};

struct FiedlerVector {
  std::vector<double> eigenvalues;  ///< the smallest, rising: 0, lambda_2, and lambda_3 if there is one and it is known
  std::vector<double> vector;       ///< that of lambda_2, per node, of unit length
  double residual = 0;              ///< |L x - lambda_2 x| / (lambda_2 |x|) as reached
  int iterations = 0;               ///< 0: solved directly
};

/// Of a connected graph of two nodes or more with weights above 0. Small graphs are solved directly, others by block
/// conjugate gradients (lobpcg.h) with a multigrid cycle (multigrid_cycle.h) as preconditioner, begun on the coarse
/// levels. lambda_3 is followed until it moves by less than ten times the tolerance in a step; a tolerance above 1e-3
/// leaves it unknown where it is far from lambda_2.
/// Where several vectors belong to lambda_2, that along a fixed function of the nodes' places (of their numbers in a
/// graph without places) is taken, and the sign so that it points along that function: the same graph has the same
/// vector, up to the tolerance, whatever found it.
FiedlerVector fiedlerVector(const FractureGraph& graph, const EigenTolerance& tolerance = {});

}  // namespace brisance
