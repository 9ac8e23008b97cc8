// Weights of a symmetric filter along one axis.
#pragma once

#include <vector>

namespace brisance {

/// 2 radius + 1 weights that sum to one, the same at equal distances on either side.
class SymmetricFilter {
 public:
  /// Leaves all as it is.
  SymmetricFilter() : weights_{1.f} {}
  /// `shape[t]` in proportion to the weight at a distance of t cells, from 0 on; shape[0] > 0.
  explicit SymmetricFilter(const std::vector<double>& shape);

  int radius() const { return static_cast<int>(weights_.size()) - 1; }
  /// Weight at a distance in cells of 0 .. radius.
  float operator()(int distance) const { return weights_[distance]; }
  /// One over the share of a cell's weights that stays inside, for each of `count` cells in a row.
  std::vector<float> gainInside(int count) const;

 private:
  std::vector<float> weights_;
};

/// Gaussian of a deviation in cells, cut off beyond `radius` cells; a deviation of 0 leaves all as it is.
SymmetricFilter gaussianFilter(double deviation, int radius);

}  // namespace brisance
