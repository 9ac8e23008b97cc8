// Random numbers addressed by (seed, stream, index): no hidden state, so any thread may draw any number in any order.
#pragma once

#include <cstdint>

#include "base/math.h"

namespace brisance {

/// Who draws: each use has a stream of its own, so that adding one never disturbs another.
enum class Stream : std::uint64_t {
  panePoints = 1,
  trisection,
  startVelocity,
  emission,
  sootPosition,
  sootVelocity,
  pixelJitter,
  fractureSeed,
  thesisRoot,
  cellSeeds,
  eigenvectorStart,
  solidCells,
  test,
  sparkWay,
  sparkSpeed,
  dust
};

class Random {
 public:
  Random(std::uint64_t seed, Stream stream)
      : key_(mix(seed + 0x9E3779B97F4A7C15u * mix(static_cast<std::uint64_t>(stream)))) {}

  /// 64 random bits (SplitMix64 finaliser: Steele, Lea & Flood 2014).
  std::uint64_t bits(std::uint64_t index) const { return mix(key_ ^ mix(index + 0x9E3779B97F4A7C15u)); }
  /// In [0, 1).
  double uniform(std::uint64_t index) const { return static_cast<double>(bits(index) >> 11) * 0x1p-53; }
  /// Mean 0, deviation 1 (Box-Muller on two draws of this index).
  double normal(std::uint64_t index) const {
    const double u = static_cast<double>((bits(index) >> 11) + 1) * 0x1p-53;
    const double angle = 2 * pi * (static_cast<double>(mix(bits(index)) >> 11) * 0x1p-53);
    return std::sqrt(-2 * portableLog(u)) * portableSinCos(angle).cos;
  }
  Vec3d normal3(std::uint64_t index) const { return {normal(3 * index), normal(3 * index + 1), normal(3 * index + 2)}; }
  /// Uniform on the unit sphere (Archimedes: height and longitude are independent and uniform).
  Vec3d onSphere(std::uint64_t index) const {
    const double z = 2 * uniform(2 * index) - 1, r = std::sqrt(std::max(0.0, 1 - z * z));
    const auto [s, c] = portableSinCos(2 * pi * uniform(2 * index + 1));
    return {r * c, r * s, z};
  }
  /// Uniform in 0 .. n-1.
  std::uint64_t below(std::uint64_t n, std::uint64_t index) const {
    return static_cast<std::uint64_t>((static_cast<Uint128>(bits(index)) * n) >> 64);
  }

 private:
  __extension__ using Uint128 = unsigned __int128;
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
};

}  // namespace brisance
