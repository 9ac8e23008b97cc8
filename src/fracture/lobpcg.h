// The smallest nonzero eigenvalues of a graph's Laplacian and their vectors (locally optimal block preconditioned
// conjugate gradients: Knyazev 2001).
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "fracture/block_vector.h"
#include "fracture/ritz.h"

namespace brisance {

/// L x = lambda M x on a connected graph: entries of row i of L weigh (x_i - x_target); M is the mass of each node.
template <class Weight>
struct EigenProblem {
  std::span<const std::uint32_t> first, targets;
  std::span<const Weight> weights;  ///< empty: all one
  std::span<const float> mass;
};

/// What the iteration reached: |L x - lambda M x| / (lambda |x|), in the norms of M^-1 and M.
template <int K>
struct EigenReport {
  std::array<double, K> eigenvalues{}, residuals{};
  int iterations = 0;
};

template <int K, class Weight>
class Lobpcg {
 public:
  using Precondition = std::function<void(const BlockVector<K, float>&, BlockVector<K, float>&)>;

  /// `x` holds the start and then the result, of unit length and orthogonal in M.
  Lobpcg(const EigenProblem<Weight>& problem, BlockVector<K, double>& x, const Precondition& precondition)
      : problem_(problem),
        x_(x),
        precondition_(precondition),
        n_(x.size()),
        image_(n_),
        direction_(n_),
        directionImage_(n_),
        residual_(n_),
        correction_(n_),
        correctionImage_(n_) {
    for (const float m : problem.mass) totalMass_ += m;
  }

  /// Until the residuals of the `wanted` first pairs are below the tolerance, and the eigenvalues of the others have
  /// come to rest: they move by less than ten times the tolerance, relative, in a step. (The others mostly help: how
  /// fast the first converge depends on the gap to what is not in the block.)
  EigenReport<K> run(double tolerance, int wanted, int mostIterations) {
    xMean_ = mean(x_);
    applyLaplacian(x_, image_);
    update(ritzVectors(gram(1), K), 1);
    EigenReport<K> report = residual();
    std::array<double, K> before;
    before.fill(HUGE_VAL);
    while (report.iterations < mostIterations && !reached(report, before, tolerance, wanted)) {
      before = report.eigenvalues;
      precondition_(residual_, correction_);
      correctionMean_ = mean(correction_);
      applyLaplacian(correction_, correctionImage_);
      const int blocks = report.iterations == 0 ? 2 : 3;
      update(ritzVectors(gram(blocks), K), blocks);
      const int iterations = report.iterations + 1;
      report = residual();
      report.iterations = iterations;
    }
    return report;
  }

 private:
  static bool reached(const EigenReport<K>& report, const std::array<double, K>& before, double tolerance, int wanted) {
    constexpr double atRest = 10;
    for (int c = 0; c < K; ++c) {
      const double moved = std::abs(before[c] - report.eigenvalues[c]);
      if (c < wanted ? !(report.residuals[c] <= tolerance) : !(moved <= atRest * tolerance * report.eigenvalues[c]))
        return false;
    }
    return true;
  }

  double weight(std::uint32_t k) const {
    return problem_.weights.empty() ? 1.0 : static_cast<double>(problem_.weights[k]);
  }

  template <class Real>
  std::array<double, K> mean(const BlockVector<K, Real>& vectors) const {
    std::array<double, K> sums = sumOverNodes<K>(n_, [&](std::uint32_t begin, std::uint32_t end, auto& out) {
      for (std::uint32_t i = begin; i < end; ++i)
        for (int c = 0; c < K; ++c) out[c] += static_cast<double>(problem_.mass[i]) * vectors[i][c];
    });
    for (double& sum : sums) sum /= totalMass_;
    return sums;
  }

  template <class Real>
  std::array<double, K> laplacianOf(const BlockVector<K, Real>& vectors, std::uint32_t i) const {
    std::array<double, K> sum{};
    for (std::uint32_t k = problem_.first[i]; k < problem_.first[i + 1]; ++k) {
      const std::array<Real, K>& target = vectors[problem_.targets[k]];
      for (int c = 0; c < K; ++c) sum[c] += weight(k) * (static_cast<double>(vectors[i][c]) - target[c]);
    }
    return sum;
  }
  template <class Real>
  void applyLaplacian(const BlockVector<K, Real>& vectors, BlockVector<K, double>& image) const {
    forNodes(n_, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) image[i] = laplacianOf(vectors, i);
    });
  }

  /// The row of the basis (x, correction, direction) at a node, and that of its image under L. Without the means: a
  /// constant has no energy at all, and would grow out of the rounding.
  void gather(std::uint32_t i, std::array<double, 3 * K>& basis, std::array<double, 3 * K>& image) const {
    for (int c = 0; c < K; ++c) {
      basis[c] = x_[i][c] - xMean_[c];
      basis[K + c] = correction_[i][c] - correctionMean_[c];
      basis[2 * K + c] = direction_[i][c];
      image[c] = image_[i][c];
      image[K + c] = correctionImage_[i][c];
      image[2 * K + c] = directionImage_[i][c];
    }
  }

  /// S^T L S and S^T M S for the first blocks of the basis S.
  GramMatrices gram(int blocks) const {
    constexpr int n = 3 * K, pairs = n * (n + 1) / 2;
    const auto sums = sumOverNodes<2 * pairs>(n_, [&](std::uint32_t begin, std::uint32_t end, auto& out) {
      std::array<double, n> basis{}, image{};
      for (std::uint32_t i = begin; i < end; ++i) {
        gather(i, basis, image);
        for (int p = 0, at = 0; p < n; ++p) {
          const double weighted = problem_.mass[i] * basis[p];
          for (int q = p; q < n; ++q, ++at) {
            out[at] += basis[p] * image[q];
            out[pairs + at] += weighted * basis[q];
          }
        }
      }
    });
    GramMatrices gram(blocks * K);
    for (int p = 0, at = 0; p < n; ++p)
      for (int q = p; q < n; ++q, ++at)
        if (q < blocks * K) gram.set(p, q, sums[at], sums[pairs + at]);
    return gram;
  }

  /// x becomes the best of the basis; the part that was not x is the next direction.
  void update(const RitzVectors& ritz, int blocks) {
    eigenvalues_ = ritz.values;
    forNodes(n_, [&](std::uint32_t begin, std::uint32_t end) {
      std::array<double, 3 * K> basis{}, image{};
      for (std::uint32_t i = begin; i < end; ++i) {
        gather(i, basis, image);
        for (int c = 0; c < K; ++c) {
          double along = 0, step = 0, stepImage = 0;
          for (int q = 0; q < K; ++q) along += ritz.coefficient(q, c) * basis[q];
          for (int q = K; q < blocks * K; ++q) {
            step += ritz.coefficient(q, c) * basis[q];
            stepImage += ritz.coefficient(q, c) * image[q];
          }
          x_[i][c] = along + step;
          direction_[i][c] = step;
          directionImage_[i][c] = stepImage;
        }
      }
    });
  }

  /// L x anew, so that no error gathers, and each residual relative to its eigenvalue.
  EigenReport<K> residual() {
    const auto sums = sumOverNodes<3 * K>(n_, [&](std::uint32_t begin, std::uint32_t end, auto& out) {
      for (std::uint32_t i = begin; i < end; ++i) {
        image_[i] = laplacianOf(x_, i);
        for (int c = 0; c < K; ++c) {
          const double mass = problem_.mass[i];
          const double left = image_[i][c] / eigenvalues_[c] - mass * x_[i][c];
          residual_[i][c] = static_cast<float>(left);
          out[c] += left * left / mass;
          out[K + c] += mass * x_[i][c] * x_[i][c];
          out[2 * K + c] += mass * x_[i][c];
        }
      }
    });
    EigenReport<K> report;
    for (int c = 0; c < K; ++c) {
      report.eigenvalues[c] = eigenvalues_[c];
      report.residuals[c] = std::sqrt(sums[c] / sums[K + c]);
      xMean_[c] = sums[2 * K + c] / totalMass_;
    }
    return report;
  }

  const EigenProblem<Weight> problem_;
  BlockVector<K, double>& x_;
  const Precondition& precondition_;
  std::size_t n_;
  double totalMass_ = 0;
  std::vector<double> eigenvalues_;
  std::array<double, K> xMean_{}, correctionMean_{};
  BlockVector<K, double> image_, direction_, directionImage_;
  BlockVector<K, float> residual_, correction_;
  BlockVector<K, double> correctionImage_;
};

}  // namespace brisance
