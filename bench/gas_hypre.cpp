#ifdef BRISANCE_HAS_HYPRE
#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <mpi.h>

#include <memory>

#include "gas_peers.h"

namespace brisance::bench {

namespace {
void startMpi() {
  int started = 0;
  MPI_Initialized(&started);
  if (started) return;
  MPI_Init(nullptr, nullptr);
  HYPRE_Init();
}

/// The symmetric matrix of the box: diagonal and the upper neighbours; solid cells are rows of the unit matrix.
class HypreSystem {
 public:
  explicit HypreSystem(const PeerProblem& problem) : n_(problem.op.cells), tolerance_(problem.tolerance) {
    startMpi();
    for (int axis = 0; axis < 3; ++axis) upper_[axis] = n_[axis] - 1;
    HYPRE_StructGridCreate(MPI_COMM_WORLD, 3, &grid_);
    HYPRE_StructGridSetExtents(grid_, lower_, upper_);
    HYPRE_StructGridAssemble(grid_);
    fillMatrix(problem);
    for (HYPRE_StructVector* vector : {&b_, &x_}) {
      HYPRE_StructVectorCreate(MPI_COMM_WORLD, grid_, vector);
      HYPRE_StructVectorInitialize(*vector);
      HYPRE_StructVectorAssemble(*vector);
    }
    values_.resize(static_cast<std::size_t>(n_.x) * n_.y * n_.z);
    load(problem.b);
    makeSolver();
  }
  ~HypreSystem() {
    HYPRE_StructPCGDestroy(solver_);
    HYPRE_StructPFMGDestroy(multigrid_);
    HYPRE_StructVectorDestroy(b_);
    HYPRE_StructVectorDestroy(x_);
    HYPRE_StructMatrixDestroy(matrix_);
    HYPRE_StructGridDestroy(grid_);
  }
  HypreSystem(const HypreSystem&) = delete;
  HypreSystem& operator=(const HypreSystem&) = delete;

  int solve(CellField& field) {
    load(field);
    HYPRE_StructPCGSolve(solver_, matrix_, b_, x_);
    HYPRE_StructVectorGetBoxValues(x_, lower_, upper_, values_.data());
    std::size_t at = 0;
    forRows([&](int j, int k) {
      for (int i = 0; i < n_.x; ++i) field(i, j, k) = static_cast<float>(values_[at++]);
    });
    int iterations = 0;
    HYPRE_StructPCGGetNumIterations(solver_, &iterations);
    return iterations;
  }

 private:
  template <class Visit>
  void forRows(const Visit& visit) const {
    for (int k = 0; k < n_.z; ++k)
      for (int j = 0; j < n_.y; ++j) visit(j, k);
  }
  void load(const CellField& b) {
    std::size_t at = 0;
    forRows([&](int j, int k) {
      for (int i = 0; i < n_.x; ++i) values_[at++] = b(i, j, k);
    });
    HYPRE_StructVectorSetBoxValues(b_, lower_, upper_, values_.data());
    std::fill(values_.begin(), values_.end(), 0.0);
    HYPRE_StructVectorSetBoxValues(x_, lower_, upper_, values_.data());
  }
  void fillMatrix(const PeerProblem& problem) {
    constexpr int entries = 4;
    int offsets[entries][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, numbers[entries] = {0, 1, 2, 3};
    HYPRE_StructStencil stencil;
    HYPRE_StructStencilCreate(3, entries, &stencil);
    for (int entry = 0; entry < entries; ++entry) HYPRE_StructStencilSetElement(stencil, entry, offsets[entry]);
    HYPRE_StructMatrixCreate(MPI_COMM_WORLD, grid_, stencil, &matrix_);
    HYPRE_StructMatrixSetSymmetric(matrix_, 1);
    HYPRE_StructMatrixInitialize(matrix_);
    std::vector<double> values;
    const MacVelocity& share = problem.op.share;
    forRows([&](int j, int k) {
      for (int i = 0; i < n_.x; ++i) {
        const double u = share.u(i + 1, j, k), v = share.v(i, j + 1, k), w = share.w(i, j, k + 1);
        const double sum = share.u(i, j, k) + u + share.v(i, j, k) + v + share.w(i, j, k) + w;
        values.insert(values.end(),
                      {sum > 0 ? sum : 1, i + 1 < n_.x ? -u : 0, j + 1 < n_.y ? -v : 0, k + 1 < n_.z ? -w : 0});
      }
    });
    HYPRE_StructMatrixSetBoxValues(matrix_, lower_, upper_, entries, numbers, values.data());
    HYPRE_StructMatrixAssemble(matrix_);
    HYPRE_StructStencilDestroy(stencil);
  }
  void makeSolver() {
    constexpr int weightedJacobi = 1, mostIterations = 200;
    HYPRE_StructPFMGCreate(MPI_COMM_WORLD, &multigrid_);
    HYPRE_StructPFMGSetRelaxType(multigrid_, weightedJacobi);
    HYPRE_StructPFMGSetNumPreRelax(multigrid_, 1);
    HYPRE_StructPFMGSetNumPostRelax(multigrid_, 1);
    HYPRE_StructPFMGSetSkipRelax(multigrid_, 1);
    HYPRE_StructPFMGSetMaxIter(multigrid_, 1);
    HYPRE_StructPFMGSetTol(multigrid_, 0);
    HYPRE_StructPFMGSetZeroGuess(multigrid_);
    HYPRE_StructPCGCreate(MPI_COMM_WORLD, &solver_);
    HYPRE_StructPCGSetMaxIter(solver_, mostIterations);
    HYPRE_StructPCGSetTol(solver_, tolerance_);
    HYPRE_StructPCGSetTwoNorm(solver_, 1);
    HYPRE_StructPCGSetPrecond(solver_, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid_);
    HYPRE_StructPCGSetup(solver_, matrix_, b_, x_);
  }

  Vec3i n_;
  double tolerance_;
  int lower_[3] = {0, 0, 0}, upper_[3] = {};
  std::vector<double> values_;
  HYPRE_StructGrid grid_;
  HYPRE_StructMatrix matrix_;
  HYPRE_StructVector b_, x_;
  HYPRE_StructSolver multigrid_, solver_;
};
}  // namespace

PeerSolve makeHypre(const PeerProblem& problem) {
  const auto system = std::make_shared<HypreSystem>(problem);
  return [system](CellField& x) { return PeerResult{system->solve(x), 1}; };  // one process, and hypre has no threads
}

}  // namespace brisance::bench
#endif
