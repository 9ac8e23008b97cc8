#include "render/cryptomatte.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace brisance {
namespace {

std::uint32_t scrambledWord(std::uint32_t word) { return std::rotl(word * 0xCC9E2D51u, 15) * 0x1B873593u; }

/// Up to four bytes, the first one lowest.
std::uint32_t wordOf(std::string_view bytes) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) word |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return word;
}

std::string hexId(std::string_view name) {
  return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(cryptomatteId(name)));
}

}  // namespace

std::uint32_t murmurHash3(std::string_view text) {
  std::uint32_t hash = 0;
  std::string_view rest = text;
  for (; rest.size() >= 4; rest.remove_prefix(4))
    hash = std::rotl(hash ^ scrambledWord(wordOf(rest.substr(0, 4))), 13) * 5 + 0xE6546B64u;
  if (!rest.empty()) hash ^= scrambledWord(wordOf(rest));
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ (hash >> 16)) * 0x85EBCA6Bu;
  hash = (hash ^ (hash >> 13)) * 0xC2B2AE35u;
  return hash ^ (hash >> 16);
}

float cryptomatteId(std::string_view name) {
  std::uint32_t hash = murmurHash3(name);
  const std::uint32_t exponent = (hash >> 23) & 255;
  if (exponent == 0 || exponent == 255) hash ^= 1u << 23;
  return std::bit_cast<float>(hash);
}

std::map<std::string, std::string> cryptomatteHeader(const std::string& layer, const std::vector<std::string>& names) {
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : names) manifest[name] = hexId(name);
  const std::string prefix = "cryptomatte/" + fmt::format("{:08x}", murmurHash3(layer)).substr(0, 7) + "/";
  return {{prefix + "name", layer},
          {prefix + "hash", "MurmurHash3_32"},
          {prefix + "conversion", "uint32_to_float32"},
          {prefix + "manifest", manifest.dump()}};
}

}  // namespace brisance
