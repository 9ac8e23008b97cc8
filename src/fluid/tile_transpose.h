// Rows of a field become lines that lie side by side, 16 at a time, and back.
#pragma once

#include <cstdint>

namespace brisance {

/// lines[i * 16 + r] = rows[r * rowStride + i] for i < roundedLength, a multiple of 16. Lines of rows beyond rowCount
/// are zero.
void rowsToLines(const float* rows, std::int64_t rowStride, int rowCount, int roundedLength, float* lines);
/// The way back; rows beyond rowCount are not written.
void linesToRows(const float* lines, int roundedLength, float* rows, std::int64_t rowStride, int rowCount);

}  // namespace brisance
