#ifdef BRISANCE_HAS_HYPRE
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_lobpcg.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <numeric>

#include "base/check.h"
#include "bench/fracture_peers.h"

namespace brisance::peers {
namespace {

/// MPI for one process, as long as the program runs.
struct Session {
  Session() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~Session() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

HYPRE_IJMatrix laplacian(const FractureGraph& graph, double shift) {
  const HYPRE_Int n = graph.nodeCount();
  HYPRE_IJMatrix matrix;
  HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, n - 1, 0, n - 1, &matrix);
  HYPRE_IJMatrixSetObjectType(matrix, HYPRE_PARCSR);
  std::vector<HYPRE_Int> lengths(n), columns;
  std::vector<HYPRE_Int> rows(n);
  std::vector<double> values;
  std::iota(rows.begin(), rows.end(), 0);
  for (HYPRE_Int i = 0; i < n; ++i) {
    const std::size_t diagonal = columns.size();
    columns.push_back(i);
    values.push_back(shift);
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      columns.push_back(static_cast<HYPRE_Int>(graph.targets[k]));
      values.push_back(-graph.weights[k]);
      values[diagonal] += graph.weights[k];
    }
    lengths[i] = static_cast<HYPRE_Int>(columns.size() - diagonal);
  }
  HYPRE_IJMatrixSetRowSizes(matrix, lengths.data());
  HYPRE_IJMatrixInitialize(matrix);
  HYPRE_IJMatrixSetValues(matrix, n, lengths.data(), rows.data(), columns.data(), values.data());
  HYPRE_IJMatrixAssemble(matrix);
  return matrix;
}

HYPRE_IJVector constant(HYPRE_Int n, double value) {
  HYPRE_IJVector vector;
  HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, n - 1, &vector);
  HYPRE_IJVectorSetObjectType(vector, HYPRE_PARCSR);
  HYPRE_IJVectorInitialize(vector);
  const std::vector<double> values(n, value);
  HYPRE_IJVectorSetValues(vector, n, nullptr, values.data());
  HYPRE_IJVectorAssemble(vector);
  return vector;
}

HYPRE_ParVector parallel(HYPRE_IJVector vector) {
  void* object = nullptr;
  HYPRE_IJVectorGetObject(vector, &object);
  return static_cast<HYPRE_ParVector>(object);
}

/// One V-cycle with the settings that were fastest for surfaces.
HYPRE_Solver boomerAmg() {
  HYPRE_Solver amg;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetPrintLevel(amg, 0);
  HYPRE_BoomerAMGSetTol(amg, 0);
  HYPRE_BoomerAMGSetMaxIter(amg, 1);
  HYPRE_BoomerAMGSetRelaxType(amg, 6);    // symmetric Gauss-Seidel
  HYPRE_BoomerAMGSetCoarsenType(amg, 8);  // PMIS
  HYPRE_BoomerAMGSetInterpType(amg, 6);   // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
  HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25);
  return amg;
}

}  // namespace

std::vector<double> hypreFiedlerVector(const FractureGraph& graph) {
  static const Session session;
  double largest = 0;
  for (const double weight : graph.weights) largest = std::max(largest, weight);
  const HYPRE_Int n = graph.nodeCount();
  HYPRE_IJMatrix matrix = laplacian(graph, 1e-9 * largest);
  void* object = nullptr;
  HYPRE_IJMatrixGetObject(matrix, &object);
  auto* const a = static_cast<HYPRE_ParCSRMatrix>(object);
  HYPRE_IJVector start = constant(n, 0), ones = constant(n, 1);
  mv_InterfaceInterpreter interpreter;
  HYPRE_MatvecFunctions products;
  HYPRE_ParCSRSetupInterpreter(&interpreter);
  HYPRE_ParCSRSetupMatvec(&products);
  constexpr int block = 2;
  mv_MultiVectorPtr vectors = mv_MultiVectorCreateFromSampleVector(&interpreter, block, parallel(start));
  mv_MultiVectorPtr constraint = mv_MultiVectorCreateFromSampleVector(&interpreter, 1, parallel(ones));
  auto* const constraintVector = static_cast<mv_TempMultiVector*>(mv_MultiVectorGetData(constraint));
  HYPRE_ParVectorCopy(parallel(ones), static_cast<HYPRE_ParVector>(constraintVector->vector[0]));
  mv_MultiVectorSetRandom(vectors, 775);

  HYPRE_Solver amg = boomerAmg(), lobpcg;
  HYPRE_LOBPCGCreate(&interpreter, &products, &lobpcg);
  HYPRE_LOBPCGSetMaxIter(lobpcg, 300);
  HYPRE_LOBPCGSetPrecondUsageMode(lobpcg, 1);
  HYPRE_LOBPCGSetTol(lobpcg, 0);
  HYPRE_LOBPCGSetRTol(lobpcg, 1e-6);
  HYPRE_LOBPCGSetPrintLevel(lobpcg, 0);
  HYPRE_LOBPCGSetPrecond(lobpcg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                         reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), amg);
  HYPRE_LOBPCGSetup(lobpcg, reinterpret_cast<HYPRE_Matrix>(a), reinterpret_cast<HYPRE_Vector>(parallel(ones)),
                    reinterpret_cast<HYPRE_Vector>(parallel(start)));
  std::array<double, block> eigenvalues{};
  HYPRE_LOBPCGSolve(lobpcg, constraint, vectors, eigenvalues.data());

  auto* const found = static_cast<mv_TempMultiVector*>(mv_MultiVectorGetData(vectors));
  HYPRE_ParVectorCopy(static_cast<HYPRE_ParVector>(found->vector[0]), parallel(start));
  std::vector<double> result(n);
  HYPRE_IJVectorGetValues(start, n, nullptr, result.data());
  HYPRE_LOBPCGDestroy(lobpcg);
  HYPRE_BoomerAMGDestroy(amg);
  mv_MultiVectorDestroy(vectors);
  mv_MultiVectorDestroy(constraint);
  HYPRE_IJVectorDestroy(start);
  HYPRE_IJVectorDestroy(ones);
  HYPRE_IJMatrixDestroy(matrix);
  return result;
}

}  // namespace brisance::peers
#endif
