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
    const Pair pair = next();
    return {first(pair), unit(scrambled(swappedSobol(pair.index), static_cast<std::uint32_t>(mixed(pair.seed))))};
  }
  float number() { return first(next()); }
  /// Numbers for a way of its own: however many it draws, those of this sequence stay where they are, evenly spread.
  SampleSequence branch() { return {mixed(pixel_ + ++pairs_ * golden), sample_}; }
  /// Bits for a run of numbers that are not spread evenly.
  std::uint64_t bits() { return mixed(mixed(pixel_ + ++pairs_ * golden) + sample_ * golden); }

  static std::uint64_t mixed(std::uint64_t z) {  // SplitMix64's finaliser
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;

 private:
  struct Pair {
    std::uint64_t seed;
    std::uint32_t index;  ///< of this sample in the shuffled sequence
  };
  Pair next() {
    const std::uint64_t seed = mixed(pixel_ + ++pairs_ * golden);
    return {seed, scrambled(swapped(sample_), static_cast<std::uint32_t>(seed))};
  }
  static float first(const Pair& pair) {
    return unit(scrambled(pair.index, static_cast<std::uint32_t>(pair.seed >> 32)));
  }
  static float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
  /// The order of the bits turned round.
  static std::uint32_t swapped(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFu) << 8) | ((x >> 8) & 0x00FF00FFu);
    x = ((x & 0x0F0F0F0Fu) << 4) | ((x >> 4) & 0x0F0F0F0Fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  }
  /// Sobol's second dimension, swapped: with the bits of the index as a polynomial over GF(2), that of x + 1. Half
  /// after half, since (x + 1)^16 = x^16 + 1.
  static std::uint32_t swappedSobol(std::uint32_t index) {
    index ^= index >> 16;
    index ^= (index >> 8) & 0x00FF00FFu;
    index ^= (index >> 4) & 0x0F0F0F0Fu;
    index ^= (index >> 2) & 0x33333333u;
    return index ^ ((index >> 1) & 0x55555555u);
  }
  /// Of a swapped number each bit is flipped by a hash of the bits above it (the constants are Burley's).
  static std::uint32_t scrambled(std::uint32_t swappedX, std::uint32_t seed) {
    std::uint32_t x = swappedX + seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    x ^= x * 0x8D22F6E6u;
    return swapped(x);
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
