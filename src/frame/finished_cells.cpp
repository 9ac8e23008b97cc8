#include "frame/finished_cells.h"

#include <immintrin.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/check.h"
#include "base/stream_copy.h"
#include "base/vector_path.h"

namespace brisance {

namespace {

/// Named as a vector, for the compiler makes single loads and stores of a loop over threes and fours.
typedef float Vector __attribute__((vector_size(cellsPerLine * sizeof(float)), may_alias));

/// A line of densities and its three of colours.
struct CellLines {
  Vector density, colour[3];
};

// Functions of vectors are inlined into those that name the instruction set.

[[gnu::always_inline]] inline void firstOfFours(const Vector (&cells)[4], Vector& mass) {
  const Vector low = __builtin_shufflevector(cells[0], cells[1], 0, 4, 8, 12, 16, 20, 24, 28, -1, -1, -1, -1, -1, -1,
                                             -1, -1),
               high = __builtin_shufflevector(cells[2], cells[3], 0, 4, 8, 12, 16, 20, 24, 28, -1, -1, -1, -1, -1, -1,
                                              -1, -1);
  mass = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
}

/// Of the numbers of a row's colours, the cell, and where it lies among the sums.
constexpr int cellOf(int number) { return number / 3; }
constexpr int placeOf(int number) { return cellOf(number) * sumsPerCell + 1 + number % 3; }

/// Line `n` of the three that the cells' colours fill, each number times that of its cell. Four cells lie in a vector,
/// their colours in lines one after the other: line n starts in the n-th of the vectors and ends in the next.
template <int n, int... number>
[[gnu::always_inline]] inline void meanColours(const Vector (&cells)[4], const Vector& perMass, Vector& line,
                                               std::integer_sequence<int, number...>) {
  line = __builtin_shufflevector(cells[n], cells[n + 1], (placeOf(cellsPerLine * n + number) - cellsPerLine * n)...);
  line *= __builtin_shufflevector(perMass, perMass, cellOf(cellsPerLine * n + number)...);
}

[[gnu::target("avx512f")]] inline void finishLine(const float* sums, float perVolume, CellLines& lines) {
  Vector cells[4], mass;  // four cells each
  for (int v = 0; v < 4; ++v) cells[v] = Vector(_mm512_loadu_ps(sums + cellsPerLine * v));
  firstOfFours(cells, mass);
  lines.density = mass * perVolume;
  const Vector none{}, perMass = mass > none ? (none + 1) / mass : none;
  constexpr auto numbers = std::make_integer_sequence<int, cellsPerLine>();
  meanColours<0>(cells, perMass, lines.colour[0], numbers);
  meanColours<1>(cells, perMass, lines.colour[1], numbers);
  meanColours<2>(cells, perMass, lines.colour[2], numbers);
}

/// The first `count` cells of a line, by the way through the caches, where rows of cells meet in a line.
[[gnu::target("avx512f")]] void storePart(const CellLines& lines, int count, float* density, float* colour) {
  const auto firstOnes = [](int numbers) { return (std::uint64_t{1} << numbers) - 1; };
  _mm512_mask_storeu_ps(density, static_cast<__mmask16>(firstOnes(count)), __m512(lines.density));
  for (int v = 0; v < 3; ++v)
    _mm512_mask_storeu_ps(colour + cellsPerLine * v, static_cast<__mmask16>(firstOnes(3 * count) >> cellsPerLine * v),
                          __m512(lines.colour[v]));
}

[[gnu::target("avx512f")]] void streamLines(const CellLines& lines, float* density, float* colour) {
  _mm512_stream_ps(density, __m512(lines.density));
  for (int v = 0; v < 3; ++v) _mm512_stream_ps(colour + cellsPerLine * v, __m512(lines.colour[v]));
}

/// Cells between the start of the line and this one.
int cellsBefore(const float* density) {
  return static_cast<int>(reinterpret_cast<std::uintptr_t>(density) / sizeof(float) % cellsPerLine);
}

int cellsUntilLine(const float* density, int count) {
  const int before = cellsBefore(density);
  return before == 0 ? 0 : std::min(count, cellsPerLine - before);
}

[[gnu::target("avx512f")]] void finishWide(const float* sums, int count, float perVolume, float* density,
                                           float* colour) {
  CellLines lines;
  int n = cellsUntilLine(density, count);
  if (n > 0) {
    finishLine(sums, perVolume, lines);
    storePart(lines, n, density, colour);
  }
  for (; n + cellsPerLine <= count; n += cellsPerLine) {
    finishLine(sums + sumsPerCell * n, perVolume, lines);
    streamLines(lines, density + n, colour + 3 * n);
  }
  if (n < count) {
    finishLine(sums + sumsPerCell * n, perVolume, lines);
    storePart(lines, count - n, density + n, colour + 3 * n);
  }
}

void finishNarrow(const float* sums, int count, float perVolume, float* density, float* colour) {
  alignas(64) float densities[mostFinishedCells], colours[3 * mostFinishedCells];
  runWide([&] {
    for (int n = 0; n < count; ++n) {
      const float* cell = sums + sumsPerCell * n;
      const float mass = cell[0], perMass = mass > 0 ? 1 / mass : 0.0f;
      densities[n] = mass * perVolume;
      for (int c = 0; c < 3; ++c) colours[3 * n + c] = cell[1 + c] * perMass;
    }
  });
  streamCopy(density, densities, count);
  streamCopy(colour, colours, 3 * count);
}

}  // namespace

void finishCells(const float* sums, int count, float perVolume, float* density, float* colour) {
  CHECK(count <= mostFinishedCells, "{} cells at once", count);
  if (vectorPath() == VectorPath::avx512) return finishWide(sums, count, perVolume, density, colour);
  finishNarrow(sums, count, perVolume, density, colour);
}

void fetchLastLines(const float* densityEnd, const float* colourEnd) {
  constexpr int toWrite = 1;
  const int cells = cellsBefore(densityEnd);
  if (cells == 0) return;
  __builtin_prefetch(densityEnd - cells, toWrite);
  for (int n = 0; n < 3 * cells; n += cellsPerLine) __builtin_prefetch(colourEnd - 3 * cells + n, toWrite);
}

}  // namespace brisance
