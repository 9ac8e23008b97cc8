// Where freed memory goes.
#pragma once

namespace brisance {

/// Tells the C library to keep what the program frees for its next use, instead of giving it back to the system: a
/// step frees and takes the same tens of megabytes again and again, and fresh pages cost more than the work on them.
/// The most memory ever in use stays what it was. Call it once, before other threads start.
void keepFreedMemory();

}  // namespace brisance
