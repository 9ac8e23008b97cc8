// Sums of a symmetric filter over rows of numbers, as loops over wide vectors. For runWithVectors().
#pragma once

#include <immintrin.h>

#include <utility>

#include "base/named_vectors.h"

namespace brisance::blur {

constexpr int widestFloats = 16;  ///< what the widest vectors hold; sums come in pieces of as many
constexpr int rowsAtOnce = 4;     ///< neighbouring rows, which share most of what they sum
constexpr int largestFixed = 4;   ///< filters up to this radius have loops of their own
constexpr int vectorsAlong = 4;   ///< of a row, the sums of which stay in registers
constexpr int pieceAlong = vectorsAlong * widestFloats;

/// Named as vectors, since the compiler would otherwise run along the filter, one cell at a time.
template <int floats>
using Vectors = NamedVectors<floats>;

/// Where whole pieces from `first` on end, that hold all until `end`.
constexpr int endOfPieces(int first, int end, int piece) { return first + (end - first + piece - 1) / piece * piece; }

/// How sums are made.
struct Sums {
  int fixedRadius;   ///< of the filter, as it is known to the compiler, or any (0)
  bool centreIsOne;  ///< the weight at a distance of 0: a sum starts with what is there
  bool fused;        ///< whether products are added without a rounding in between, where the processor can
};

using Widest = Vectors<widestFloats>::Type;

[[gnu::target("avx512f")]] inline void addFused(const Widest& numbers, float weight, Widest& sum) {
  sum = Widest(_mm512_fmadd_ps(__m512(numbers), _mm512_set1_ps(weight), __m512(sum)));
}

template <Sums how>
struct Weights {
  static constexpr int fixedRadius = how.fixedRadius;
  const float* weights;  // at a distance of 0 .. radius
  int anyRadius;
  int radius() const { return fixedRadius > 0 ? fixedRadius : anyRadius; }

  template <class Numbers>
  void begin(const Numbers& centre, Numbers& sum) const {
    sum = centre;
    if constexpr (!how.centreIsOne) sum *= weights[0];
  }
  template <class Numbers>
  void add(const Numbers& pair, int distance, Numbers& sum) const {
    if constexpr (how.fused && sizeof(Numbers) == sizeof(Widest))
      addFused(pair, weights[distance], sum);
    else
      sum += pair * weights[distance];
  }
};

/// Filtered sums of rows 0 .. 3 over rows[-radius] .. rows[radius + 3], of a vector of numbers from `at` on. The rows
/// at a distance t below and above each are those at t - 1 of its neighbours, so that two are loaded for four sums.
/// Where `cleared`, the first four of the rows become zero.
template <int floats, bool cleared, class Filter>
inline void sumFour(float* const* rows, const Filter& filter, int at,
                    typename Vectors<floats>::Type (&sum)[rowsAtOnce]) {
  using V = Vectors<floats>;
  typename V::Type below[rowsAtOnce], above[rowsAtOnce];
  for (int q = 0; q < rowsAtOnce; ++q) {
    below[q] = above[q] = V::at(rows[q] + at);
    filter.begin(below[q], sum[q]);
  }
  for (int t = 1; t <= filter.radius(); ++t) {
    for (int q = rowsAtOnce - 1; q > 0; --q) below[q] = below[q - 1];
    for (int q = 0; q < rowsAtOnce - 1; ++q) above[q] = above[q + 1];
    below[0] = V::at(rows[-t] + at);
    above[rowsAtOnce - 1] = V::at(rows[rowsAtOnce - 1 + t] + at);
    for (int q = 0; q < rowsAtOnce; ++q) {
      const typename V::Type pair = below[q] + above[q];
      filter.add(pair, t, sum[q]);
    }
  }
  for (int q = 0; cleared && q < rowsAtOnce; ++q) V::at(rows[q - filter.radius()] + at) = typename V::Type{};
}

/// The same of the pieces of numbers from `first` until `end`.
template <int floats, bool cleared, class Filter>
inline void sumNeighbours(float* const* rows, const Filter& filter, int first, int end, float* const* sums) {
  using V = Vectors<floats>;
  for (int at = first; at < endOfPieces(first, end, widestFloats); at += floats) {
    typename V::Type sum[rowsAtOnce];
    sumFour<floats, cleared>(rows, filter, at, sum);
    for (int q = 0; q < rowsAtOnce; ++q) V::at(sums[q] + at) = sum[q];
  }
}

/// The numbers from `shift` on of two neighbouring vectors.
template <int shift, int... n>
inline void shiftInto(Widest& result, const Widest& first, const Widest& second, std::integer_sequence<int, n...>) {
  result = __builtin_shufflevector(first, second, (n + shift)...);
}
template <int shift>
inline void shiftInto(Widest& result, const Widest& first, const Widest& second) {
  shiftInto<shift>(result, first, second, std::make_integer_sequence<int, widestFloats>());
}

/// Adds what lies `distance` numbers, so many cells, to the left and right of the numbers in `here`, a vector of a row.
/// `left` is what lies to the left of them, and then of the next vector's: with four numbers a cell, some of it lies to
/// the right of these.
template <int distance, class Filter>
inline void addPair(Widest& left, const Widest& here, const Widest& next, const Filter& filter, int cells,
                    Widest& sum) {
  Widest right;
  shiftInto<distance>(right, here, next);
  const Widest pair = left + right;
  filter.add(pair, cells, sum);
  shiftInto<widestFloats - distance>(left, here, next);
}

/// Whether vectors are so wide, and filters so short, that sums along a row are made by shifting vectors in registers.
/// Narrower vectors take longer to shift than to load.
template <int floats, int fixedRadius>
constexpr bool shiftsVectors = fixedRadius > 0 && floats == widestFloats;

/// Sums of four neighbouring rows, as sumNeighbours makes them and clears what it reads, summed along the rows, whose
/// cells have so many channels, before they leave the registers. Sums of rows before `first` are taken to be zero.
template <int channels, class Filter, int... t>
inline void sumBothWaysShifted(float* const* rows, const Filter& filter, int first, int end, float* const* sums,
                               std::integer_sequence<int, t...>) {
  constexpr int fixedRadius = Filter::fixedRadius;
  static_assert(channels * fixedRadius <= widestFloats);
  Widest left[rowsAtOnce][fixedRadius], here[rowsAtOnce], next[rowsAtOnce];
  sumFour<widestFloats, true>(rows, filter, first, next);
  for (int q = 0; q < rowsAtOnce; ++q) (shiftInto<widestFloats - channels*(t + 1)>(left[q][t], Widest{}, next[q]), ...);
  for (int at = first; at < end; at += widestFloats) {
    for (int q = 0; q < rowsAtOnce; ++q) here[q] = next[q];
    sumFour<widestFloats, true>(rows, filter, at + widestFloats, next);
    for (int q = 0; q < rowsAtOnce; ++q) {
      Widest sum;
      filter.begin(here[q], sum);
      (addPair<channels*(t + 1)>(left[q][t], here[q], next[q], filter, t + 1, sum), ...);
      Vectors<widestFloats>::at(sums[q] + at) = sum;
    }
  }
}
template <int channels, class Filter>
inline void sumBothWaysShifted(float* const* rows, const Filter& filter, int first, int end, float* const* sums) {
  sumBothWaysShifted<channels>(rows, filter, first, end, sums, std::make_integer_sequence<int, Filter::fixedRadius>());
}

/// Filtered sums along a row of cells with so many channels, of the pieces of numbers from `first` until `end`, each
/// vector loaded from where it lies.
template <int floats, int channels, class Filter>
inline void sumAlong(const float* row, const Filter& filter, int first, int end, float* sums) {
  using V = Vectors<floats>;
  for (int at = first; at < endOfPieces(first, end, pieceAlong); at += vectorsAlong * floats) {
    typename V::Type sum[vectorsAlong];
    for (int v = 0; v < vectorsAlong; ++v) {
      const typename V::Type centre = V::at(row + at + v * floats);
      filter.begin(centre, sum[v]);
    }
    for (int t = 1; t <= filter.radius(); ++t) {
      const float *left = row + at - channels * t, *right = row + at + channels * t;
      for (int v = 0; v < vectorsAlong; ++v) {
        const typename V::Type pair = V::at(left + v * floats) + V::at(right + v * floats);
        filter.add(pair, t, sum[v]);
      }
    }
    for (int v = 0; v < vectorsAlong; ++v) V::at(sums + at + v * floats) = sum[v];
  }
}

}  // namespace brisance::blur
