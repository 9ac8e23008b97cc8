// What breaking costs, beside peers on the same input in the same run (rows as What/Input/Size/Who).
// Each subject has a file of its own: fracture_NAME.cpp.
#include "base/memory.h"

namespace {

/// As the program itself does; it helps the peers as much.
const bool keepsMemory = [] {
  brisance::keepFreedMemory();
  return true;
}();

}  // namespace
