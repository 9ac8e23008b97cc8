#ifdef BRISANCE_HAS_SPECTRA
#pragma GCC diagnostic ignored "-Wconversion"
#include <Spectra/SymEigsShiftSolver.h>
#include <Eigen/Sparse>

#include "base/check.h"
#include "base/random.h"
#include "bench/fracture_peers.h"

namespace brisance::peers {
namespace {

/// The inverse of L, shifted a little off its zero, on vectors without a mean.
class ShiftedInverse {
 public:
  using Scalar = double;
  using Sparse = Eigen::SparseMatrix<double>;

  ShiftedInverse(const FractureGraph& graph, double shift) : size_(graph.nodeCount()) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(graph.targets.size() + graph.first.size());
    for (int i = 0; i < size_; ++i) {
      double sum = shift;
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
        const int j = static_cast<int>(graph.targets[k]);
        sum += graph.weights[k];
        if (j < i) entries.emplace_back(i, j, -graph.weights[k]);
      }
      entries.emplace_back(i, i, sum);
    }
    Sparse lower(size_, size_);
    lower.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(lower);
    CHECK(factors_.info() == Eigen::Success);
  }
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  void set_shift(double) {}
  void perform_op(const double* in, double* out) const {
    Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(in, size_);
    b.array() -= b.mean();
    Eigen::VectorXd x = factors_.solve(b);
    x.array() -= x.mean();
    Eigen::Map<Eigen::VectorXd>(out, size_) = x;
  }

 private:
  int size_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factors_;
};

}  // namespace

std::vector<double> spectraFiedlerVector(const FractureGraph& graph) {
  double largest = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(graph.nodeCount()); ++i) {
    double sum = 0;
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) sum += graph.weights[k];
    largest = std::max(largest, sum);
  }
  const double shift = 1e-9 * largest;
  ShiftedInverse inverse(graph, shift);
  constexpr int basis = 8, mostRestarts = 200;
  constexpr double tolerance = 2e-8;  // of the inverse's pairs: what leaves 1e-6 for those of L
  Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, 1, basis, -shift);
  std::vector<double> start(graph.nodeCount());
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = Random(7, Stream::test).normal(i);
  solver.init(start.data());
  solver.compute(Spectra::SortRule::LargestMagn, mostRestarts, tolerance, Spectra::SortRule::LargestMagn);
  CHECK(solver.info() == Spectra::CompInfo::Successful);
  const Eigen::VectorXd vector = solver.eigenvectors().col(0);
  return {vector.begin(), vector.end()};
}

}  // namespace brisance::peers
#endif
