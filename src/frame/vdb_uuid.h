// The name that OpenVDB gives to a file: random by the library, of the content here, so that equal content is equal
// bytes.
#pragma once

#include <cstdint>
#include <string>

#include "base/check.h"

namespace brisance {

/// `bytes` begin as a VDB file does: magic number, two versions (one of two numbers), a flag, the UUID. `hash` has 32
/// digits.
inline std::string withUuid(std::string bytes, std::string hash) {
  constexpr std::size_t place = sizeof(std::int64_t) + 3 * sizeof(std::uint32_t) + sizeof(char);
  for (const std::size_t dash : {8, 13, 18, 23}) {
    CHECK(bytes.size() > place + dash && bytes[place + dash] == '-', "no UUID in the header of the VDB");
    hash.insert(dash, "-");
  }
  return bytes.replace(place, hash.size(), hash);
}

}  // namespace brisance
