// Stores past the caches, for results too large to be still there when they are read: an ordinary store fetches the
// line first, so that each byte written crosses the memory's bus twice.
#pragma once

#include <emmintrin.h>

#include <bit>
#include <cstdint>

namespace brisance {

/// Stores `count` floats, value(n) giving four from the n-th on and single(n) one, past the caches.
template <class Four, class One>
inline void streamFloats(float* to, std::int64_t count, const Four& four, const One& one) {
  const auto storeOne = [&](std::int64_t n) {
    _mm_stream_si32(reinterpret_cast<int*>(to + n), std::bit_cast<std::int32_t>(one(n)));
  };
  constexpr std::int64_t vector = 4;
  std::int64_t n = 0;
  for (; n < count && reinterpret_cast<std::uintptr_t>(to + n) % sizeof(__m128) != 0; ++n) storeOne(n);
  for (; n + vector <= count; n += vector) _mm_stream_ps(to + n, four(n));
  for (; n < count; ++n) storeOne(n);
}
inline void streamCopy(float* to, const float* from, std::int64_t count) {
  streamFloats(
      to, count, [=](std::int64_t n) { return _mm_loadu_ps(from + n); }, [=](std::int64_t n) { return from[n]; });
}
inline void streamZeros(float* to, std::int64_t count) {
  streamFloats(
      to, count, [](std::int64_t) { return _mm_setzero_ps(); }, [](std::int64_t) { return 0.f; });
}

/// To be called by a thread that has streamed before others read what it stored.
inline void endStreaming() { _mm_sfence(); }

}  // namespace brisance
