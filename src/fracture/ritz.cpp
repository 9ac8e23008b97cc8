#include "fracture/ritz.h"

#include <Eigen/Dense>

#include "base/check.h"

namespace brisance {

RitzVectors ritzVectors(const GramMatrices& gram, int count) {
  using Matrix = Eigen::MatrixXd;
  const int n = gram.size();
  const Eigen::Map<const Matrix> energy(gram.energy(), n, n), mass(gram.mass(), n, n);
  constexpr double tiny = 1e-300, dependent = 1e-12;
  const Eigen::VectorXd scale = mass.diagonal().array().max(tiny).sqrt().inverse();
  const Matrix scaledMass = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> ofMass(scaledMass);
  const auto kept = (ofMass.eigenvalues().array() > dependent).count();
  CHECK(kept >= count, "{} of {} basis vectors are independent", kept, n);
  const Matrix orthonormal =
      scale.asDiagonal() *
      (ofMass.eigenvectors().rightCols(kept) * ofMass.eigenvalues().tail(kept).array().rsqrt().matrix().asDiagonal());
  const Eigen::SelfAdjointEigenSolver<Matrix> ofEnergy(orthonormal.transpose() * energy * orthonormal);
  const Matrix vectors = orthonormal * ofEnergy.eigenvectors().leftCols(count);
  RitzVectors result;
  result.values.assign(ofEnergy.eigenvalues().data(), ofEnergy.eigenvalues().data() + count);
  result.coefficients.assign(vectors.data(), vectors.data() + vectors.size());
  result.basisSize = n;
  return result;
}

}  // namespace brisance
