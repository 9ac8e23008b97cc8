// Sums that wide vectors make, with the same bits whatever their width.
#pragma once

#include <cstdint>

namespace brisance {

/// term(0) + .. + term(count - 1) in double, added in 16 interleaved parts.
template <class Term>
inline double laneSum(std::int64_t count, const Term& term) {
  constexpr int lanes = 16;
  double parts[lanes] = {};
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int l = 0; l < lanes; ++l) parts[l] += static_cast<double>(term(i + l));
  for (int l = 0; i + l < count; ++l) parts[l] += static_cast<double>(term(i + l));
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

/// The largest magnitude of term(0) .. term(count - 1), likewise; not a number counts as nothing.
template <class Term>
inline float laneMax(std::int64_t count, const Term& term) {
  constexpr int lanes = 16;
  float parts[lanes] = {};
  const auto take = [&](int l, float value) { parts[l] = value > parts[l] ? value : parts[l]; };
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int l = 0; l < lanes; ++l) take(l, __builtin_fabsf(term(i + l)));
  for (int l = 0; i + l < count; ++l) take(l, __builtin_fabsf(term(i + l)));
  float largest = 0;
  for (const float part : parts) largest = part > largest ? part : largest;
  return largest;
}

}  // namespace brisance
