#include "base/memory.h"

#include <malloc.h>

namespace brisance {

void keepFreedMemory() {
  constexpr int largestInHeap = 32 << 20;  // bytes: the most that the library takes from what it kept
  constexpr int keptAtTop = 1 << 30;       // bytes
  ::mallopt(M_MMAP_THRESHOLD, largestInHeap);
  ::mallopt(M_TRIM_THRESHOLD, keptAtTop);
}

void releaseFreedMemory() { ::malloc_trim(0); }

}  // namespace brisance
