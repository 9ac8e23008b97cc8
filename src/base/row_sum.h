// Sums and maxima over many rows of samples, for loops over wide vectors, with the same bits whatever their width.
#pragma once

#include <cstdint>

#include "base/aligned.h"

namespace brisance {

/// The sum of what is added row by row, in double: one part for each place in a row, the parts added in order at last.
class RowSum {
 public:
  explicit RowSum(int length) : parts_(length, 0.0) {}
  /// Adds term(0) .. term(length - 1).
  template <class Term>
  void add(const Term& term) {
    double* parts = parts_.data();
    const std::int64_t count = std::ssize(parts_);
#pragma GCC ivdep
    for (std::int64_t i = 0; i < count; ++i) parts[i] += static_cast<double>(term(i));
  }
  /// For loops that add to several sums at once: the part of each place.
  double* parts() { return parts_.data(); }
  /// The sum so far; the next one begins at 0.
  double take() {
    double sum = 0;
    for (double& part : parts_) {
      sum += part;
      part = 0;
    }
    return sum;
  }

 private:
  AlignedVector<double> parts_;
};

/// Likewise the largest value, 0 if all are less; not a number counts as nothing.
class RowMax {
 public:
  explicit RowMax(int length) : parts_(length, 0.0f) {}
  template <class Term>
  void add(const Term& term) {
    float* parts = parts_.data();
    const std::int64_t count = std::ssize(parts_);
#pragma GCC ivdep
    for (std::int64_t i = 0; i < count; ++i) {
      const float value = term(i);
      parts[i] = value > parts[i] ? value : parts[i];
    }
  }
  float* parts() { return parts_.data(); }
  float take() {
    float largest = 0;
    for (float& part : parts_) {
      largest = part > largest ? part : largest;
      part = 0;
    }
    return largest;
  }

 private:
  AlignedVector<float> parts_;
};

}  // namespace brisance
