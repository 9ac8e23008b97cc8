#include "base/stream_copy.h"

#include <immintrin.h>

#include <algorithm>

#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr std::int64_t lineFloats = 16;

[[gnu::target("avx512f")]] void storeWideLines(float* to, const float* from, std::int64_t lines) {
  for (std::int64_t n = 0; n < lines; ++n)
    _mm512_stream_ps(to + lineFloats * n, _mm512_loadu_ps(from + lineFloats * n));
}
void storeLines(float* to, const float* from, std::int64_t lines) {
  if (vectorPath() == VectorPath::avx512) return storeWideLines(to, from, lines);
  constexpr std::int64_t vectorFloats = 4;
  for (std::int64_t n = 0; n < lines * lineFloats; n += vectorFloats) _mm_stream_ps(to + n, _mm_loadu_ps(from + n));
}

void storeFew(float* to, const float* from, std::int64_t count) {
  for (std::int64_t n = 0; n < count; ++n) to[n] = from[n];
}

/// What is missing of a line. Lines that are written in parts take the way through the caches, where the parts meet.
std::int64_t untilLine(const float* to) {
  const std::uintptr_t beyond = reinterpret_cast<std::uintptr_t>(to) / sizeof(float) % lineFloats;
  return beyond == 0 ? 0 : lineFloats - static_cast<std::int64_t>(beyond);
}
}  // namespace

void streamCopy(float* to, const float* from, std::int64_t count) {
  const std::int64_t head = std::min(untilLine(to), count), lines = (count - head) / lineFloats;
  const std::int64_t done = head + lines * lineFloats;
  storeFew(to, from, head);
  storeLines(to + head, from + head, lines);
  storeFew(to + done, from + done, count - done);
}

void streamZeros(float* to, std::int64_t count) {
  constexpr std::int64_t most = 256;
  static constexpr float zeros[most] = {};
  for (std::int64_t n = 0; n < count; n += most) streamCopy(to + n, zeros, std::min(most, count - n));
}

void endStreaming() { _mm_sfence(); }

}  // namespace brisance
