// Sums that wide vectors make, with the same bits whatever their width.
#pragma once

#include <cstdint>

namespace brisance {

namespace detail {
/// Calls take(lane, i) for i < count, lane i modulo 16. The lanes are independent: 16 at a time are one vector, which
/// the compiler does not see if it unrolls them first.
template <class Take>
inline void forLanes(std::int64_t count, const Take& take) {
  constexpr int atOnce = 16;
  std::int64_t i = 0;
  for (; i + atOnce <= count; i += atOnce) {
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < atOnce; ++l) take(l, i + l);
  }
  for (int l = 0; i + l < count; ++l) take(l, i + l);
}
}  // namespace detail

/// term(0) + .. + term(count - 1) in double, added in 16 interleaved parts.
template <class Term>
inline double laneSum(std::int64_t count, const Term& term) {
  double parts[16] = {};
  detail::forLanes(count, [&](int l, std::int64_t i) { parts[l] += static_cast<double>(term(i)); });
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

/// The largest magnitude of term(0) .. term(count - 1), likewise; not a number counts as nothing.
template <class Term>
inline float laneMax(std::int64_t count, const Term& term) {
  float parts[16] = {};
  detail::forLanes(count, [&](int l, std::int64_t i) {
    const float value = __builtin_fabsf(term(i));
    parts[l] = value > parts[l] ? value : parts[l];
  });
  float largest = 0;
  for (const float part : parts) largest = part > largest ? part : largest;
  return largest;
}

}  // namespace brisance
