// Other people's eigen-solvers on our graphs; each is there only where its library is.
#pragma once

#include "fracture/fracture_graph.h"

namespace brisance::peers {

/// LOBPCG preconditioned by one BoomerAMG cycle, constants projected out, to |L x - lambda x| <= 1e-6 lambda |x|.
std::vector<double> hypreFiedlerVector(const FractureGraph& graph);
/// Shift-invert Lanczos over Eigen's sparse LDLT.
std::vector<double> spectraFiedlerVector(const FractureGraph& graph);

}  // namespace brisance::peers
