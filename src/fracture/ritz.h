// Best approximations of eigenvectors in a small basis (Rayleigh-Ritz).
#pragma once

#include <vector>

namespace brisance {

/// S^T L S and S^T M S of a basis S of few vectors.
class GramMatrices {
 public:
  explicit GramMatrices(int size) : size_(size), energy_(size * size), mass_(size * size) {}
  void set(int p, int q, double energy, double mass) {
    energy_[p * size_ + q] = energy_[q * size_ + p] = energy;
    mass_[p * size_ + q] = mass_[q * size_ + p] = mass;
  }
  int size() const { return size_; }
  const double* energy() const { return energy_.data(); }
  const double* mass() const { return mass_.data(); }

 private:
  int size_;
  std::vector<double> energy_, mass_;
};

/// Of the smallest eigenvalues, rising.
struct RitzVectors {
  std::vector<double> values;
  std::vector<double> coefficients;  ///< one column after the other
  int basisSize = 0;
  double coefficient(int basis, int vector) const { return coefficients[vector * basisSize + basis]; }
};

/// Vectors of the basis that are combinations of the others up to rounding are left out.
RitzVectors ritzVectors(const GramMatrices& gram, int count);

}  // namespace brisance
