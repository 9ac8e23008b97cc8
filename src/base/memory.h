// Where freed memory goes.
#pragma once

namespace brisance {

/// Tells the C library to keep what the program frees for its next use, instead of giving it back to the system: a
/// step frees and takes the same tens of megabytes again and again, and fresh pages cost more than the work on them.
/// The most memory ever in use stays what it was. Call it once, before other threads start.
void keepFreedMemory();

/// Gives back what was freed and kept. Each thread keeps its own: what one frees, another takes anew, and work that
/// changes threads from frame to frame would in time hold its memory several times.
void releaseFreedMemory();

}  // namespace brisance
