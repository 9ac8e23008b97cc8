// Density and colour of cells from their blurred sums, on the way to memory.
#pragma once

namespace brisance {

constexpr int sumsPerCell = 4;          ///< mass, and mass times red, green, blue
constexpr int cellsPerLine = 16;        ///< densities in a line of memory; their colours are three lines
constexpr int mostFinishedCells = 256;  ///< at once

/// Sets density = mass * perVolume and the mean colour, zero where there is no mass, of `count` cells. `density` and
/// `colour` (three numbers a cell) lie equally many cells from the start of a line; whole lines are stored past the
/// caches, for endStreaming(). `sums` has room for whole lines of cells from any cell on. The same bits for any
/// vectors.
void finishCells(const float* sums, int count, float perVolume, float* density, float* colour);

/// Asks for the lines in which cells end that do not fill them, to be told while others are finished: stores of parts
/// of lines wait for the rest, and all stores after them.
void fetchLastLines(const float* densityEnd, const float* colourEnd);

}  // namespace brisance
