// Stores past the caches, for results too large to be still there when they are read: an ordinary store may fetch the
// line first, so that each byte written crosses the memory's bus twice, and it throws other lines out. Lines that
// are not written as a whole are stored as usual.
#pragma once

#include <cstdint>

namespace brisance {

void streamCopy(float* to, const float* from, std::int64_t count);
void streamZeros(float* to, std::int64_t count);

/// To be called by a thread that has streamed before others read what it stored.
void endStreaming();

}  // namespace brisance
