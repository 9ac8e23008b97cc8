// The samples of the gas, kept only where there is gas.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "base/aligned.h"
#include "base/math.h"

namespace brisance {

/// A sample of the gas as one vector of the processor: density times light, and the density.
struct GasSample {
  using Vector [[gnu::vector_size(16)]] = float;
  Vector values{};
  float density() const { return values[3]; }
  Vec3f light() const {
    return Vec3f(values[0], values[1], values[2]) / values[3];
  }  ///< I of equation A.4, where there is density
};

/// Numbers >= 0 of a sample in 16 bits: six of exponent and ten of fraction, so that shifted they are the bits of a
/// float times `unit`. Relative error at most 1/2048 from `smallest` on; below it 0, above `largest` that.
struct GasCode {
  static constexpr int shift = 13;
  static constexpr float unit = 0x1p95f, smallest = 0x1p-24f, largest = 0x1p31f;

  static std::uint32_t of(float value) {
    const float scaled = (value >= smallest ? std::min(value, largest) : 0) * (1 / unit);  // what is no number: 0
    return (std::bit_cast<std::uint32_t>(scaled) + (1u << (shift - 1))) >> shift;
  }
  /// Of the lower and the upper code of a word, times 1 / unit.
  static float lower(std::uint32_t word) { return std::bit_cast<float>((word & 0xffffu) << shift); }
  static float upper(std::uint32_t word) { return std::bit_cast<float>(word >> 16 << shift); }
};

/// The samples of a block of 8^3 cells and the first ones of the next block on each upper side, so that a place in the
/// block reads one brick.
struct alignas(64) GasBrick {
  static constexpr int cells = 8, edge = cells + 1, count = edge * edge * edge;
  static constexpr int wordsOfSample = 2;

  std::uint32_t words[wordsOfSample * count];  ///< two codes each: red and green, blue and density
  std::int32_t block;                          ///< its number among all blocks

  static constexpr int index(int x, int y, int z) { return x + edge * (y + edge * z); }
  void encode(const GasSample* samples) {
    const auto* values = reinterpret_cast<const float*>(samples);
    for (int n = 0; n < wordsOfSample * count; ++n)
      words[n] = GasCode::of(values[2 * n]) | GasCode::of(values[2 * n + 1]) << 16;
  }
  void decode(GasSample* samples) const {
    auto* values = reinterpret_cast<float*>(samples);
    for (int n = 0; n < wordsOfSample * count; ++n) {
      values[2 * n] = GasCode::lower(words[n]) * GasCode::unit;
      values[2 * n + 1] = GasCode::upper(words[n]) * GasCode::unit;
    }
  }

  /// Between the eight samples from number `first` on; shares 0 .. 1 along each axis.
  [[gnu::always_inline]] GasSample between(int first, float x, float y, float z) const {
    return {mixed(words + wordsOfSample * first, x, y, z).values * GasCode::unit};
  }
  /// The same at a place in cells from the brick's first sample, cut to the brick.
  GasSample at(const Vec3f& cellsIn) const;

  /// Samples counted through all bricks of an array: those from the array's first word to brick n's first sample.
  static constexpr std::uint32_t samplesBefore(std::uint32_t n);
  static const std::uint32_t* wordsOf(const GasBrick* bricks, std::uint32_t sample) {
    return reinterpret_cast<const std::uint32_t*>(bricks) + std::size_t{wordsOfSample} * sample;
  }
  /// As between(), over GasCode::unit. Two neighbours in x, near and far in z, are one vector.
  [[gnu::always_inline]] static GasSample mixed(const std::uint32_t* words, float x, float y, float z) {
    Four low, up;
    read(words, low);
    read(words + wordsOfSample * edge, up);
    low += (up - low) * y;
    Pair near = __builtin_shufflevector(low, low, 0, 1, 2, 3, 4, 5, 6, 7);
    const Pair far = __builtin_shufflevector(low, low, 8, 9, 10, 11, 12, 13, 14, 15);
    near += (far - near) * z;
    const GasSample::Vector left = __builtin_shufflevector(near, near, 0, 1, 2, 3),
                            right = __builtin_shufflevector(near, near, 4, 5, 6, 7);
    return {left + (right - left) * x};
  }

 private:
  using Pair [[gnu::vector_size(32)]] = float;
  using Four [[gnu::vector_size(64)]] = float;
  using Codes [[gnu::vector_size(16)]] = std::uint16_t;
  using Bits [[gnu::vector_size(64)]] = std::uint32_t;
  using MoreCodes [[gnu::vector_size(32)]] = std::uint16_t;

  /// By reference, since without wide vectors no function may return one.
  [[gnu::always_inline]] static void read(const std::uint32_t* words, Four& four) {
    Codes near, far;
    std::memcpy(&near, words, sizeof near);
    std::memcpy(&far, words + wordsOfSample * edge * edge, sizeof far);
    const MoreCodes both = __builtin_shufflevector(near, far, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const Bits bits = __builtin_convertvector(both, Bits) << GasCode::shift;
    four = reinterpret_cast<Four>(bits);
  }
};

constexpr std::uint32_t GasBrick::samplesBefore(std::uint32_t n) {
  constexpr std::uint32_t each = sizeof(GasBrick) / (wordsOfSample * sizeof(std::uint32_t));
  static_assert(each * wordsOfSample * sizeof(std::uint32_t) == sizeof(GasBrick));
  return n * each;
}

/// Room for bricks, used again from frame to frame and in huge pages: fresh small ones cost more time than the samples
/// in them.
struct BrickMemory {
  using Allocator = CacheLineAllocator<GasBrick>;
  struct Release {
    void operator()(GasBrick* bricks) const { Allocator().deallocate(bricks, 0); }
  };
  std::unique_ptr<GasBrick[], Release> bricks;
  std::int64_t room = 0;
  /// Makes room for `count`; what was held is lost when it has to grow.
  void reserve(std::int64_t count);
};

}  // namespace brisance
