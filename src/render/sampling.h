// How the samples of a pixel are weighed.
#pragma once

#include <vector>

namespace brisance {

/// Weights of n x n sub-pixels, row by row: 1 at the pixel's edge and 1.5 inside, divided by their sum (appendix
/// A.1.3).
inline std::vector<float> subPixelWeights(int n) {
  constexpr float edge = 1, inside = 1.5f;
  std::vector<float> weights;
  float sum = 0;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const bool atEdge = row == 0 || column == 0 || row == n - 1 || column == n - 1;
      weights.push_back(atEdge ? edge : inside);
      sum += weights.back();
    }
  for (float& weight : weights) weight /= sum;
  return weights;
}

}  // namespace brisance
