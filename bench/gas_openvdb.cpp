#ifdef BRISANCE_HAS_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/PoissonSolver.h>

#include "gas_peers.h"

namespace brisance::bench {

namespace {
openvdb::FloatTree treeOf(const CellField& field, const Vec3i& n) {
  openvdb::FloatTree tree(0);
  openvdb::tree::ValueAccessor<openvdb::FloatTree> values(tree);
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) values.setValue(openvdb::Coord(i, j, k), field(i, j, k));
  return tree;
}
}  // namespace

PeerSolve makeOpenVdb(const PeerProblem& problem) {
  openvdb::initialize();
  const Vec3i n = problem.op.cells;
  const auto source = std::make_shared<const openvdb::FloatTree>(treeOf(problem.b, n));
  const double tolerance = problem.tolerance;
  const int threads = problem.threads;
  return [=](CellField& x) {
    constexpr int mostIterations = 5000;
    auto state = openvdb::math::pcg::terminationDefaults<float>();
    state.iterations = mostIterations;
    state.relativeError = tolerance;
    state.absoluteError = 1e-30;  // the relative one decides
    const auto walled = [](const openvdb::Coord&, const openvdb::Coord&, double&, double&) {};
    openvdb::util::NullInterrupter uninterrupted;
    namespace poisson = openvdb::tools::poisson;
    const auto solution = poisson::solveWithBoundaryConditionsAndPreconditioner<
        openvdb::math::pcg::IncompleteCholeskyPreconditioner<poisson::LaplacianMatrix>>(*source, walled, state,
                                                                                        uninterrupted, true);
    openvdb::tree::ValueAccessor<openvdb::FloatTree> values(*solution);
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) x(i, j, k) = -values.getValue(openvdb::Coord(i, j, k));
    return PeerResult{static_cast<int>(state.iterations), threads};
  };
}

}  // namespace brisance::bench
#endif
