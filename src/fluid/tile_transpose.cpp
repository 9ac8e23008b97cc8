#include "fluid/tile_transpose.h"

#include <xmmintrin.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int tile = 16;

/// A 16 x 16 tile whose missing rows are zero.
struct Tile {
  alignas(64) float values[tile * tile];
};

// The compiler splits wide vectors of a function before it learns that the function is meant for wide vectors; so the
// wide transposition says so itself, where other loops leave it to runWide.
using Vector [[gnu::vector_size(64)]] = float;

constexpr int block = 4;  // what one part of a vector holds; to stay within parts costs half as much as to cross them
template <class Pick, std::size_t... lane>
[[gnu::target("avx512f"), gnu::always_inline]] inline Vector pick(const Vector& a, const Vector& b, Pick,
                                                                  std::index_sequence<lane...>) {
  return __builtin_shufflevector(a, b, Pick::from(lane)...);
}
template <class Pick>
[[gnu::target("avx512f"), gnu::always_inline]] inline Vector pick(const Vector& a, const Vector& b) {
  return pick(a, b, Pick(), std::make_index_sequence<tile>());
}
/// In each block the lower (half 0) or upper numbers of a and b, taken in turns, by one (run 1) or by two (run 2).
template <int run, int half>
struct InTurns {
  static constexpr int from(int lane) {
    const int place = lane % block, pair = place / run;
    return (lane - place) + (pair % 2 ? tile : 0) + half * 2 + (run == 1 ? place / 2 : place % 2);
  }
};
/// Every other block of a, from the first or second on, and then of b.
template <int half>
struct EveryOther {
  static constexpr int from(int lane) {
    const int number = lane / block;
    return (number / 2 ? tile : 0) + (2 * (number % 2) + half) * block + lane % block;
  }
};

/// Number c of row r, all rows of a group of four, to number r of row c, in each block.
[[gnu::target("avx512f"), gnu::always_inline]] inline void transposeBlocks(Vector* rows) {
  const Vector a = pick<InTurns<1, 0>>(rows[0], rows[1]), b = pick<InTurns<1, 1>>(rows[0], rows[1]);
  const Vector c = pick<InTurns<1, 0>>(rows[2], rows[3]), d = pick<InTurns<1, 1>>(rows[2], rows[3]);
  rows[0] = pick<InTurns<2, 0>>(a, c);
  rows[1] = pick<InTurns<2, 1>>(a, c);
  rows[2] = pick<InTurns<2, 0>>(b, d);
  rows[3] = pick<InTurns<2, 1>>(b, d);
}
/// Block c of row r to block r of row c, of rows four apart.
[[gnu::target("avx512f"), gnu::always_inline]] inline void exchangeBlocks(Vector* rows) {
  const Vector a = pick<EveryOther<0>>(rows[0], rows[4]), b = pick<EveryOther<1>>(rows[0], rows[4]);
  const Vector c = pick<EveryOther<0>>(rows[8], rows[12]), d = pick<EveryOther<1>>(rows[8], rows[12]);
  rows[0] = pick<EveryOther<0>>(a, c);
  rows[4] = pick<EveryOther<0>>(b, d);
  rows[8] = pick<EveryOther<1>>(a, c);
  rows[12] = pick<EveryOther<1>>(b, d);
}

[[gnu::target("avx512f")]] void transposeWide(const float* from, std::int64_t fromStride, float* to,
                                              std::int64_t toStride) {
  Vector rows[tile];
#pragma GCC unroll 16
  for (int r = 0; r < tile; ++r) std::memcpy(&rows[r], from + r * fromStride, sizeof(Vector));
#pragma GCC unroll 4
  for (int r = 0; r < tile; r += block) transposeBlocks(rows + r);
#pragma GCC unroll 4
  for (int r = 0; r < block; ++r) exchangeBlocks(rows + r);
#pragma GCC unroll 16
  for (int r = 0; r < tile; ++r) std::memcpy(to + r * toStride, &rows[r], sizeof(Vector));
}

/// By blocks of 4 x 4, which every x86-64 processor can do.
void transposeNarrow(const float* from, std::int64_t fromStride, float* to, std::int64_t toStride) {
  for (int r = 0; r < tile; r += 4)
    for (int i = 0; i < tile; i += 4) {
      __m128 rows[4];
      for (int n = 0; n < 4; ++n) rows[n] = _mm_loadu_ps(from + (r + n) * fromStride + i);
      _MM_TRANSPOSE4_PS(rows[0], rows[1], rows[2], rows[3]);
      for (int n = 0; n < 4; ++n) _mm_storeu_ps(to + (i + n) * toStride + r, rows[n]);
    }
}

void transpose(const float* from, std::int64_t fromStride, float* to, std::int64_t toStride) {
  if (vectorPath() == VectorPath::avx512)
    transposeWide(from, fromStride, to, toStride);
  else
    transposeNarrow(from, fromStride, to, toStride);
}
}  // namespace

void rowsToLines(const float* rows, std::int64_t rowStride, int rowCount, int roundedLength, float* lines) {
  for (int i = 0; i < roundedLength; i += tile) {
    if (rowCount >= tile) {
      for (int r = tile; r < 2 * tile; ++r) __builtin_prefetch(rows + r * rowStride + i);
      transpose(rows + i, rowStride, lines + i * tile, tile);
      continue;
    }
    Tile part{};
    for (int r = 0; r < rowCount; ++r) std::copy_n(rows + r * rowStride + i, tile, part.values + r * tile);
    transpose(part.values, tile, lines + i * tile, tile);
  }
}

void linesToRows(const float* lines, int roundedLength, float* rows, std::int64_t rowStride, int rowCount) {
  for (int i = 0; i < roundedLength; i += tile) {
    if (rowCount >= tile) {
      transpose(lines + i * tile, tile, rows + i, rowStride);
      continue;
    }
    Tile part;
    transpose(lines + i * tile, tile, part.values, tile);
    for (int r = 0; r < rowCount; ++r) std::copy_n(part.values + r * tile, tile, rows + r * rowStride + i);
  }
}

}  // namespace brisance
