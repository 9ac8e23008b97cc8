// Loops over rows of samples, a line of the cache at a time, that ask for memory before they come to it: the processor
// follows a few streams by itself, a sweep over a dozen fields waits for each.
#pragma once

#include <bit>
#include <cstdint>

namespace brisance {

constexpr int lineFloats = 16;  // of 64 bytes

/// Calls visit(i) for all i < count, in vectors, and before each line of them fetch(i). Where the last line is not a
/// whole one, some are visited twice: `visit` reads nothing that it writes.
template <class Fetch, class Visit>
inline void forLines(std::int64_t count, const Fetch& fetch, const Visit& visit) {
  const auto line = [&](std::int64_t first) {
    fetch(first);
#pragma GCC ivdep
#pragma GCC unroll 1
    for (std::int64_t i = first; i < first + lineFloats; ++i) visit(i);
  };
  if (count < lineFloats) {
    for (std::int64_t i = 0; i < count; ++i) visit(i);
    return;
  }
  for (std::int64_t i = 0; i + lineFloats <= count; i += lineFloats) line(i);
  if (count % lineFloats) line(count - lineFloats);
}

/// `?:` by bits: of that the compiler may make a branch around what it takes to find `yes`, and no vectors.
inline float select(bool condition, float yes, float no) {
  const std::uint32_t mask = condition ? ~std::uint32_t{0} : 0;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(yes) & mask) | (std::bit_cast<std::uint32_t>(no) & ~mask));
}

/// Asks for a line of each.
template <class... Samples>
inline void fetchToRead(std::int64_t i, const Samples*... rows) {
  asm volatile("");  // without it the compiler takes asking for nothing done, and leaves it out
  (__builtin_prefetch(rows + i), ...);
}

/// Likewise, of lines that will be written.
template <class... Samples>
inline void fetchToWrite(std::int64_t i, const Samples*... rows) {
  const auto fetch = [i](const auto* row) { asm volatile("prefetchw %0" ::"m"(row[i])); };
  (fetch(rows), ...);
}

}  // namespace brisance
