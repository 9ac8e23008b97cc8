// The gas at sixteen places at once: places in the lanes of vectors, samples one behind the other.
#pragma once

#include <immintrin.h>

#include "render/gas_bricks.h"

namespace brisance {

constexpr int packetLanes = 16;

template <class T>
struct alignas(64) PacketLanes {
  T value[packetLanes];
  T& operator[](int n) { return value[n]; }
  const T& operator[](int n) const { return value[n]; }
};
using FloatLanes = PacketLanes<float>;
using WholeLanes = PacketLanes<std::int32_t>;

/// Sixteen places in bricks, and the gas there.
struct PacketSamples {
  PacketLanes<std::uint32_t> first;           ///< of the eight samples around the place, counted through all bricks
  FloatLanes share[3];                        ///< 0 .. 1 between them along each axis
  alignas(64) GasSample sample[packetLanes];  ///< over GasCode::unit
  FloatLanes density;                         ///< over GasCode::unit
};

/// One place after the other, on any processor.
struct ReadEach {
  static void read(const GasBrick* bricks, PacketSamples& places) {
    for (int n = 0; n < packetLanes; ++n)
      places.sample[n] = GasBrick::mixed(GasBrick::wordsOf(bricks, places.first[n]), places.share[0][n],
                                         places.share[1][n], places.share[2][n]);
    for (int n = 0; n < packetLanes; ++n) places.density[n] = places.sample[n].density();
  }
};

/// Four places at a time, for processors with AVX-512: mixed in y, two places share a vector; mixed in z, four.
class ReadFours {
 public:
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void read(const GasBrick* bricks,
                                                                         PacketSamples& places) {
    Sixteen samples[4];
    for (int n = 0; n < 4; ++n) {
      mixFour(bricks, places, 4 * n, samples[n]);
      reinterpret_cast<Sixteen&>(places.sample[4 * n]) = samples[n];
    }
    const Sixteen low = __builtin_shufflevector(samples[0], samples[1], 3, 7, 11, 15, 19, 23, 27, 31, 3, 7, 11, 15, 19,
                                                23, 27, 31),
                  high = __builtin_shufflevector(samples[2], samples[3], 3, 7, 11, 15, 19, 23, 27, 31, 3, 7, 11, 15, 19,
                                                 23, 27, 31);
    const Sixteen all = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
    std::memcpy(places.density.value, &all, sizeof all);
  }

 private:
  using Sixteen [[gnu::vector_size(64), gnu::may_alias]] = float;
  using Numbers [[gnu::vector_size(64)]] = std::int32_t;

  // Vectors go by reference, since functions for other processors know no such ones.

  /// Two neighbours in x, near and far in z.
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void readPlane(const std::uint32_t* words,
                                                                              Sixteen& plane) {
    constexpr int layer = GasBrick::wordsOfSample * GasBrick::edge * GasBrick::edge;
    const auto pair = [](const std::uint32_t* at) { return reinterpret_cast<const __m128i*>(at); };
    const __m256i codes = _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(pair(words))),
                                                  _mm_loadu_si128(pair(words + layer)), 1);
    const auto bits = reinterpret_cast<Numbers>(_mm512_maskz_cvtepu16_epi32(0xffff, codes)) << GasCode::shift;
    plane = reinterpret_cast<Sixteen>(bits);
  }
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void mixY(const std::uint32_t* words, float share,
                                                                         Sixteen& mixed) {
    Sixteen low, up;
    readPlane(words, low);
    readPlane(words + GasBrick::wordsOfSample * GasBrick::edge, up);
    mixed = low + (up - low) * share;
  }
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void mixZ(const Sixteen& one, const Sixteen& other,
                                                                         const Sixteen& share, Sixteen& mixed) {
    const Sixteen near = __builtin_shufflevector(one, other, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23),
                  far =
                      __builtin_shufflevector(one, other, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31);
    mixed = near + (far - near) * share;
  }
  /// Of a vector of shares, those of the places with these numbers.
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void choose(const FloatLanes& shares,
                                                                           const Numbers& numbers, Sixteen& chosen) {
    chosen = _mm512_maskz_permutexvar_ps(0xffff, reinterpret_cast<__m512i>(numbers), _mm512_load_ps(shares.value));
  }
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static void mixFour(const GasBrick* bricks,
                                                                            const PacketSamples& places, int from,
                                                                            Sixteen& samples) {
    const Numbers ofTwo = Numbers{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1} + from,
                  ofFour = Numbers{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3} + from;
    Sixteen each[4], share, one, other;
    for (int n = 0; n < 4; ++n)
      mixY(GasBrick::wordsOf(bricks, places.first[from + n]), places.share[1][from + n], each[n]);
    choose(places.share[2], ofTwo, share);
    mixZ(each[0], each[1], share, one);
    choose(places.share[2], ofTwo + 2, share);
    mixZ(each[2], each[3], share, other);
    choose(places.share[0], ofFour, share);
    const Sixteen left = __builtin_shufflevector(one, other, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27),
                  right =
                      __builtin_shufflevector(one, other, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
    samples = left + (right - left) * share;
  }
};

}  // namespace brisance
