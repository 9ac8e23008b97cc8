// Random numbers for the ways of light through one pixel: evenly spread over its samples, addressed, without state.
#pragma once

#include <cstdint>

#include "base/math.h"

namespace brisance {

/// One sample of a pixel draws pair after pair. For each pair the samples of the pixel together are a Sobol sequence,
/// Owen-scrambled and shuffled by hashing (Burley 2020, "Practical hash-based Owen scrambling").
class SampleSequence {
 public:
  /// `pixel`: random bits that differ from pixel to pixel and frame to frame.
  SampleSequence(std::uint64_t pixel, std::uint32_t sample) : pixel_(pixel), sample_(sample) {}

  /// In [0, 1) x [0, 1).
  Vec2<float> pair() {
    const std::uint64_t seed = mixed(pixel_ + ++pairs_ * golden);
    const std::uint32_t index = scrambled(sample_, static_cast<std::uint32_t>(seed));
    const auto low = static_cast<std::uint32_t>(seed >> 32), high = static_cast<std::uint32_t>(mixed(seed));
    return {unit(scrambled(reversed(index), low)), unit(scrambled(secondSobol(index), high))};
  }
  float number() { return pair().x; }
  /// Bits for a run of numbers that are not spread evenly.
  std::uint64_t bits() { return mixed(mixed(pixel_ + ++pairs_ * golden) + sample_ * golden); }

  static std::uint64_t mixed(std::uint64_t z) {  // SplitMix64's finaliser
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;

 private:
  static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  static std::uint32_t reversed(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFu) << 8) | ((x >> 8) & 0x00FF00FFu);
    x = ((x & 0x0F0F0F0Fu) << 4) | ((x >> 4) & 0x0F0F0F0Fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  }
  static std::uint32_t secondSobol(std::uint32_t index) {
    std::uint32_t bits = 0;
    for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1)
      if (index & 1) bits ^= v;
    return bits;
  }
  /// Each bit is flipped by a hash of the bits above it (the constants are Burley's).
  static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed(x) + seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    x ^= x * 0x8D22F6E6u;
    return reversed(x);
  }

  std::uint64_t pixel_;
  std::uint32_t sample_;
  std::uint64_t pairs_ = 0;
};

/// Numbers in [0, 1), as many as are wanted, from 64 bits.
class NumberRun {
 public:
  explicit NumberRun(std::uint64_t bits) : bits_(bits) {}
  float operator()() {
    return static_cast<float>(SampleSequence::mixed(bits_ += SampleSequence::golden) >> 40) * 0x1p-24f;
  }

 private:
  std::uint64_t bits_;
};

}  // namespace brisance
