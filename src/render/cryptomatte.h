// Cryptomatte (Friedman & Jones 2015; specification 1.2 of Psyop): bodies as channels by which compositors pick them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

/// MurmurHash3 (Appleby), 32 bits, seed 0.
std::uint32_t murmurHash3(std::string_view text);
/// The id of a name: its hash as the bits of a float, one bit changed where that would be no normal number.
float cryptomatteId(std::string_view name);
/// What a file's header says: names and ids of a layer.
std::map<std::string, std::string> cryptomatteHeader(const std::string& layer, const std::vector<std::string>& names);

}  // namespace brisance
