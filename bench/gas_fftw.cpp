#ifdef BRISANCE_HAS_FFTW
#include <fftw3.h>

#include <memory>
#include <numbers>

#include "base/parallel.h"
#include "gas_peers.h"

namespace brisance::bench {

namespace {
/// Cosine transforms there and back, and the division by the eigenvalues between them.
struct CosinePlans {
  Vec3i n;
  float* values;
  fftwf_plan there, back;

  CosinePlans(const Vec3i& cells, int threads)
      : n(cells), values(fftwf_alloc_real(static_cast<std::size_t>(cells.x) * cells.y * cells.z)) {
    fftwf_init_threads();
    fftwf_plan_with_nthreads(threads);
    const auto plan = [&](fftwf_r2r_kind kind) {
      return fftwf_plan_r2r_3d(n.z, n.y, n.x, values, values, kind, kind, kind, FFTW_MEASURE);
    };
    there = plan(FFTW_REDFT10);
    back = plan(FFTW_REDFT01);
  }
  ~CosinePlans() {
    fftwf_destroy_plan(there);
    fftwf_destroy_plan(back);
    fftwf_free(values);
  }
  CosinePlans(const CosinePlans&) = delete;
  CosinePlans& operator=(const CosinePlans&) = delete;
  float* row(int j, int k) const {
    return values + static_cast<std::size_t>(n.x) * (j + static_cast<std::size_t>(n.y) * k);
  }
};

std::vector<float> eigenvalues(int n) {
  std::vector<float> values(n);
  for (int k = 0; k < n; ++k) values[k] = static_cast<float>(2 - 2 * std::cos(std::numbers::pi * k / n));
  return values;
}

void divide(const CosinePlans& plans) {
  const Vec3i n = plans.n;
  const std::vector<float> x = eigenvalues(n.x), y = eigenvalues(n.y), z = eigenvalues(n.z);
  const float scale = static_cast<float>(1 / (8.0 * n.x * n.y * n.z));
  parallelFor(0, n.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) plans.row(j, k)[i] *= scale / (x[i] + (y[j] + z[k]));
  });
  plans.values[0] = 0;
}
}  // namespace

/// The copies between our layout and FFTW's are timed too; they take about 3 % of its time.
PeerSolve makeFftw(const PeerProblem& problem) {
  const int threads = problem.threads;
  const auto plans = std::make_shared<CosinePlans>(problem.op.cells, threads);
  return [plans, threads](CellField& x) {
    const Vec3i n = plans->n;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j) std::copy_n(x.row(j, k), n.x, plans->row(j, k));
    fftwf_execute(plans->there);
    divide(*plans);
    fftwf_execute(plans->back);
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j) std::copy_n(plans->row(j, k), n.x, x.row(j, k));
    return PeerResult{1, threads};
  };
}

}  // namespace brisance::bench
#endif
