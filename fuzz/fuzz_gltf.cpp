#include "fuzz/mesh_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const char* bytes, std::size_t count) {
  brisance::fuzz::takeGltf({bytes, count});
  return 0;
}
