// Sums of a symmetric filter over rows of numbers, as loops over wide vectors. For runWide().
#pragma once

#include <utility>

namespace brisance::blur {

constexpr int vectorFloats = 16;  // the widest vectors hold as many
constexpr int rowsAtOnce = 4;     // neighbouring rows, which share most of what they sum
constexpr int largestFixed = 4;   // filters up to this radius have loops of their own

/// Named as vectors, since the compiler would otherwise run along the filter, one cell at a time. Not for `auto`, which
/// forgets that they need not be aligned.
typedef float FloatVector __attribute__((vector_size(vectorFloats * sizeof(float)), aligned(sizeof(float)), may_alias));

inline const FloatVector& vectorAt(const float* numbers) { return *reinterpret_cast<const FloatVector*>(numbers); }
inline FloatVector& vectorAt(float* numbers) { return *reinterpret_cast<FloatVector*>(numbers); }

/// A filter of a radius known to the compiler, or of any (0).
template <int fixedRadius>
struct Weights {
  const float* weights;  // at a distance of 0 .. radius
  int anyRadius;
  int radius() const { return fixedRadius > 0 ? fixedRadius : anyRadius; }
};

/// Filtered sums of rows 0 .. 3 over rows[-radius] .. rows[radius + 3], of the vectors of numbers from `first` until
/// `end`. The rows at a distance t below and above each are those at t - 1 of its neighbours, so that two are loaded
/// for four sums. Where `cleared`, the first four of the rows become zero.
template <bool cleared, int fixedRadius>
inline void sumNeighbours(float* const* rows, const Weights<fixedRadius>& filter, int first, int end,
                          float* const* sums) {
  for (int at = first; at < end; at += vectorFloats) {
    FloatVector below[rowsAtOnce], above[rowsAtOnce], sum[rowsAtOnce];
    for (int q = 0; q < rowsAtOnce; ++q) {
      below[q] = above[q] = vectorAt(rows[q] + at);
      sum[q] = below[q] * filter.weights[0];
    }
    for (int t = 1; t <= filter.radius(); ++t) {
      for (int q = rowsAtOnce - 1; q > 0; --q) below[q] = below[q - 1];
      for (int q = 0; q < rowsAtOnce - 1; ++q) above[q] = above[q + 1];
      below[0] = vectorAt(rows[-t] + at);
      above[rowsAtOnce - 1] = vectorAt(rows[rowsAtOnce - 1 + t] + at);
      for (int q = 0; q < rowsAtOnce; ++q) sum[q] += (below[q] + above[q]) * filter.weights[t];
    }
    for (int q = 0; q < rowsAtOnce; ++q) {
      vectorAt(sums[q] + at) = sum[q];
      if (cleared) vectorAt(rows[q - filter.radius()] + at) = FloatVector{};
    }
  }
}

/// The numbers from `shift` on of two neighbouring vectors.
template <int shift, int... n>
inline void shiftInto(FloatVector& result, const FloatVector& first, const FloatVector& second,
                      std::integer_sequence<int, n...>) {
  result = __builtin_shufflevector(first, second, (n + shift)...);
}

/// Adds what lies `distance` numbers to the left and right of a vector's numbers.
template <int distance>
inline void addPair(const FloatVector (&around)[3], float weight, FloatVector& sum) {
  constexpr auto numbers = std::make_integer_sequence<int, vectorFloats>();
  FloatVector left, right;
  shiftInto<vectorFloats - distance>(left, around[0], around[1], numbers);
  shiftInto<distance>(right, around[1], around[2], numbers);
  sum += (left + right) * weight;
}

/// Filtered sums along a row of cells with so many channels, of the vectors of numbers from `first` until `end`. Each
/// vector is loaded once, and shifted in registers.
template <int channels, int... t>
inline void sumAlongBy(const float* row, const float* weights, int first, int end, float* sums,
                       std::integer_sequence<int, t...>) {
  FloatVector around[3] = {{}, vectorAt(row + first - vectorFloats), vectorAt(row + first)};
  for (int at = first; at < end; at += vectorFloats) {
    around[0] = around[1];
    around[1] = around[2];
    around[2] = vectorAt(row + at + vectorFloats);
    FloatVector sum = around[1] * weights[0];
    (addPair<channels*(t + 1)>(around, weights[t + 1], sum), ...);
    vectorAt(sums + at) = sum;
  }
}

template <int channels, int fixedRadius>
inline void sumAlong(const float* row, const Weights<fixedRadius>& filter, int first, int end, float* sums) {
  static_assert(channels * fixedRadius <= vectorFloats);
  sumAlongBy<channels>(row, filter.weights, first, end, sums, std::make_integer_sequence<int, fixedRadius>());
}

/// The same for any filter: a block of vectors, the sums of which stay in registers.
template <int channels>
inline void sumAlong(const float* row, const Weights<0>& filter, int first, int end, float* sums) {
  constexpr int blockVectors = 4;
  for (int at = first; at < end; at += blockVectors * vectorFloats) {
    FloatVector sum[blockVectors];
    for (int v = 0; v < blockVectors; ++v) sum[v] = vectorAt(row + at + v * vectorFloats) * filter.weights[0];
    for (int t = 1; t <= filter.radius(); ++t) {
      const float *left = row + at - channels * t, *right = row + at + channels * t;
      for (int v = 0; v < blockVectors; ++v)
        sum[v] += (vectorAt(left + v * vectorFloats) + vectorAt(right + v * vectorFloats)) * filter.weights[t];
    }
    for (int v = 0; v < blockVectors; ++v) vectorAt(sums + at + v * vectorFloats) = sum[v];
  }
}

}  // namespace brisance::blur
