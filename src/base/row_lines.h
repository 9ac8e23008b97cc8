// Loops over rows of samples that ask for memory before they come to it: the processor follows a few streams by itself,
// a sweep over a dozen fields waits for each.
#pragma once

#include <bit>
#include <cstdint>

namespace brisance {

constexpr int lineFloats = 16;  // of 64 bytes

/// `?:` by bits: of that the compiler may make a branch around what it takes to find `yes`, and no vectors.
template <class Number, class Bits>
inline Number selectBits(bool condition, Number yes, Number no) {
  const Bits mask = condition ? ~Bits{0} : 0;
  return std::bit_cast<Number>((std::bit_cast<Bits>(yes) & mask) | (std::bit_cast<Bits>(no) & ~mask));
}
inline float select(bool condition, float yes, float no) {
  return selectBits<float, std::uint32_t>(condition, yes, no);
}
inline double select(bool condition, double yes, double no) {
  return selectBits<double, std::uint64_t>(condition, yes, no);
}

/// Whether any number has other bits than `value`.
inline bool anyOther(const float* numbers, std::int64_t count, float value) {
  std::uint32_t found = 0;
  for (std::int64_t i = 0; i < count; ++i)
    found |= std::bit_cast<std::uint32_t>(numbers[i]) ^ std::bit_cast<std::uint32_t>(value);
  return found != 0;
}

/// Asks for a line of each.
template <class... Samples>
inline void fetchToRead(std::int64_t i, const Samples*... rows) {
  asm volatile("");  // without it the compiler takes asking for nothing done, and leaves it out
  (__builtin_prefetch(rows + i), ...);
}

/// Asks for all lines of some numbers.
template <class Number>
inline void fetchAll(const Number* numbers, std::int64_t count) {
  const std::int64_t bytes = count * static_cast<std::int64_t>(sizeof(Number)), line = lineFloats * sizeof(float);
  for (std::int64_t byte = 0; byte < bytes; byte += line) fetchToRead(byte, reinterpret_cast<const char*>(numbers));
}

/// Likewise, of lines that will be written.
template <class... Samples>
inline void fetchToWrite(std::int64_t i, const Samples*... rows) {
  const auto fetch = [i](const auto* row) { asm volatile("prefetchw %0" ::"m"(row[i])); };
  (fetch(rows), ...);
}

}  // namespace brisance
