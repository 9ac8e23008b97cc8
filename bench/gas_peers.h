// The peers' solvers of the same problem: h^2 (-div grad) x = b in a walled box.
#pragma once

#include <functional>

#include "fluid/cell_field.h"
#include "fluid/conjugate_gradient.h"

namespace brisance::bench {

struct PeerProblem {
  const SolidStamp& solid;
  const PressureOperator& op;
  const CellField& b;
  double tolerance;  ///< relative residual for those that iterate
  int threads;
};
struct PeerResult {
  int iterations;
  int threads;
};
/// Replaces b by x. What a peer sets up once for a matrix is done when it is made.
using PeerSolve = std::function<PeerResult(CellField&)>;

PeerSolve makeFftw(const PeerProblem& problem);     ///< single precision, r2r transforms
PeerSolve makeHypre(const PeerProblem& problem);    ///< struct PFMG as preconditioner of its conjugate gradients
PeerSolve makeOpenVdb(const PeerProblem& problem);  ///< tools::poisson, incomplete Cholesky

}  // namespace brisance::bench
