// (lambda - second difference) x = b along one axis of a box, for many lines side by side, by Gaussian elimination: two
// sweeps of three operations a sample, where transforms to modes and back take fifty.
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "fluid/trigonometric_transform.h"

namespace brisance {

/// Lines whose samples are zero where `present` says no, and are neither read nor written there.
struct SparseLines {
  float* samples;
  std::int64_t stride;  ///< from a sample to the next of its line
  const std::uint8_t* present = nullptr;

  bool has(int k) const { return !present || present[k]; }
  float* at(int k) const { return samples + k * stride; }
};

/// The equations of lines side by side. b is `scale` times what their samples hold.
struct LineEquations {
  const float* lambda;  ///< of each line; none negative
  float scale;
  int count;                         ///< of lines, a multiple of 16
  bool firstIsUndetermined = false;  ///< line 0 has lambda 0 and no open end: its b's mean is ignored, its x has none
};

class LineElimination {
 public:
  LineElimination(AxisEnds ends, int n);

  /// Room for what one thread eliminates, to be used again.
  struct Scratch {
    AlignedVector<float> shares, absent, corner;
    std::vector<double> first;
  };
  /// Replaces b by x.
  void solve(const SparseLines& lines, const LineEquations& equations, Scratch& scratch) const;

 private:
  void takeFirst(const SparseLines& lines, float scale, std::vector<double>& x) const;
  void leaveFirst(const SparseLines& lines, const std::vector<double>& x) const;

  AxisEnds ends_;
  int n_;
};

}  // namespace brisance
