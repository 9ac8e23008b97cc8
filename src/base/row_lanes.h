// Sums and maxima over many rows of samples in vectors named in the source, with the same bits whatever their width: in
// lanes, one for each place of a line of the cache, in float along a row and in double from row to row.
#pragma once

#include <array>
#include <cstdint>

#include "base/named_vectors.h"
#include "base/row_lines.h"

namespace brisance {

/// What the samples at each place of a line come to.
using Lanes = std::array<float, lineFloats>;

/// Calls block.operator()<n>(i, at) for every n samples of a row: at[0], at[1].. are theirs of the `lanes`, which it
/// changes.
template <int floats, std::size_t count, class Block>
inline void overLanes(std::int64_t length, std::array<Lanes, count>& lanes, const Block& block) {
  using V = NamedVectors<floats>;
  constexpr int parts = lineFloats / floats;
  typename V::Type at[parts][count];
#pragma GCC unroll 16
  for (int part = 0; part < parts; ++part)
#pragma GCC unroll 8
    for (std::size_t n = 0; n < count; ++n) at[part][n] = V::at(&lanes[n][part * floats]);
  std::int64_t i = 0;
  for (; i + lineFloats <= length; i += lineFloats)
#pragma GCC unroll 16
    for (int part = 0; part < parts; ++part) block.template operator()<floats>(i + part * floats, at[part]);
#pragma GCC unroll 16
  for (int part = 0; part < parts; ++part)
#pragma GCC unroll 8
    for (std::size_t n = 0; n < count; ++n) V::at(&lanes[n][part * floats]) = at[part][n];
  for (int lane = 0; i < length; ++i, ++lane) {
    typename NamedVectors<1>::Type one[count];
    for (std::size_t n = 0; n < count; ++n) one[n] = NamedVectors<1>::at(&lanes[n][lane]);
    block.template operator()<1>(i, one);
    for (std::size_t n = 0; n < count; ++n) NamedVectors<1>::at(&lanes[n][lane]) = one[n];
  }
}

/// The sum over rows of what their lanes hold.
class LaneTotal {
 public:
  void add(const Lanes& row) {
    for (int lane = 0; lane < lineFloats; ++lane) parts_[lane] += static_cast<double>(row[lane]);
  }
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
  double parts_[lineFloats] = {};
};

/// The largest of all lanes, 0 if all are less; they begin anew.
inline float takeLargest(Lanes& lanes) {
  float largest = 0;
  for (float& lane : lanes) {
    largest = lane > largest ? lane : largest;
    lane = 0;
  }
  return largest;
}

}  // namespace brisance
