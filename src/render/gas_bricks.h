// The samples of the gas, kept only where there is gas.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

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

/// The samples of a block of 8^3 cells and the first ones of the next block on each upper side, so that a place in the
/// block reads one brick: 16-bit whole numbers times a scale of the brick's own.
struct GasBrick {
  static constexpr int cells = 8, edge = cells + 1, count = edge * edge * edge;

  GasSample::Vector scale;
  std::int32_t block;              ///< its number among all blocks
  std::uint16_t codes[4 * count];  ///< the four of a sample after one another

  static constexpr int index(int x, int y, int z) { return x + edge * (y + edge * z); }
  /// Stores samples, to 1/131070 of the largest of the brick.
  void encode(const GasSample* samples) {
    constexpr float largestCode = 65535;
    constexpr float least = 1e-30f;  // what is darker has no reciprocal that a float holds
    GasSample::Vector largest{}, none{};
    for (int n = 0; n < count; ++n) largest = samples[n].values > largest ? samples[n].values : largest;
    scale = largest / largestCode;
    const GasSample::Vector perScale = largest > least ? largestCode / largest : none;
    for (int n = 0; n < count; ++n)
      for (int c = 0; c < 4; ++c)
        codes[4 * n + c] =
            static_cast<std::uint16_t>(static_cast<std::int32_t>(samples[n].values[c] * perScale[c] + 0.5f));
  }
  void decode(GasSample* samples) const {
    for (int n = 0; n < count; ++n)
      for (int c = 0; c < 4; ++c) samples[n].values[c] = static_cast<float>(codes[4 * n + c]) * scale[c];
  }

  /// Between the eight samples from number `first` on; shares 0 .. 1 along each axis. Two neighbours in x, near and far
  /// in z, are one vector.
  [[gnu::always_inline]] GasSample between(int first, float x, float y, float z) const {
    Four low, up;
    read(first, low);
    read(first + edge, up);
    low += (up - low) * y;
    Pair near = __builtin_shufflevector(low, low, 0, 1, 2, 3, 4, 5, 6, 7);
    const Pair far = __builtin_shufflevector(low, low, 8, 9, 10, 11, 12, 13, 14, 15);
    near += (far - near) * z;
    const GasSample::Vector left = __builtin_shufflevector(near, near, 0, 1, 2, 3),
                            right = __builtin_shufflevector(near, near, 4, 5, 6, 7);
    return {(left + (right - left) * x) * scale};
  }
  /// The same at a place in cells from the brick's first sample, cut to the brick.
  GasSample at(const Vec3f& cellsIn) const;

 private:
  using Pair [[gnu::vector_size(32)]] = float;
  using Four [[gnu::vector_size(64)]] = float;
  using Codes [[gnu::vector_size(16)]] = std::uint16_t;
  using MoreCodes [[gnu::vector_size(32)]] = std::uint16_t;

  /// By reference, since without wide vectors no function may return one.
  [[gnu::always_inline]] void read(int first, Four& four) const {
    Codes near, far;
    std::memcpy(&near, codes + 4 * first, sizeof near);
    std::memcpy(&far, codes + 4 * (first + edge * edge), sizeof far);
    const MoreCodes both = __builtin_shufflevector(near, far, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    four = __builtin_convertvector(both, Four);
  }
};

/// Room for bricks, used again from frame to frame: fresh pages cost more time than the samples in them.
struct BrickMemory {
  std::unique_ptr<GasBrick[]> bricks;
  std::int64_t room = 0;
  /// Makes room for `count`; what was held is lost when it has to grow.
  void reserve(std::int64_t count);
};

}  // namespace brisance
