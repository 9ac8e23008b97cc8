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

/// Exchanges bit `distance` of the row number with that of the column number.
template <int distance, std::size_t... lane>
[[gnu::target("avx512f"), gnu::always_inline]] inline void exchange(Vector& a, Vector& b,
                                                                    std::index_sequence<lane...>) {
  const Vector low = __builtin_shufflevector(a, b, (lane & distance ? tile + lane - distance : lane)...);
  const Vector high = __builtin_shufflevector(a, b, (lane & distance ? tile + lane : lane + distance)...);
  a = low;
  b = high;
}

template <int distance>
[[gnu::target("avx512f"), gnu::always_inline]] inline void exchangeAll(Vector (&rows)[tile]) {
#pragma GCC unroll 16
  for (int r = 0; r < tile; ++r)
    if (!(r & distance)) exchange<distance>(rows[r], rows[r + distance], std::make_index_sequence<tile>());
}

[[gnu::target("avx512f")]] void transposeWide(const float* from, std::int64_t fromStride, float* to,
                                              std::int64_t toStride) {
  Vector rows[tile];
#pragma GCC unroll 16
  for (int r = 0; r < tile; ++r) std::memcpy(&rows[r], from + r * fromStride, sizeof(Vector));
  exchangeAll<8>(rows);
  exchangeAll<4>(rows);
  exchangeAll<2>(rows);
  exchangeAll<1>(rows);
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
