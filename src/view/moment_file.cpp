#include "view/moment_file.h"

#define ZLIB_CONST  // what is only read is const
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/check.h"

namespace brisance {

static_assert(std::endian::native == std::endian::little, "moments are little-endian");

/// Runs of equal bytes and their frequencies are all that there is to find in residuals: looking for longer repetitions
/// takes five times as long for a hundredth.
std::string deflated(const std::string& bytes) {
  z_stream stream{};
  constexpr int largestWindow = 15, usualMemory = 8;
  CHECK(deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, largestWindow, usualMemory, Z_RLE) == Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  CHECK(result == Z_STREAM_END, "zlib says {}", result);
  return packed;
}

std::string packMoment(const nlohmann::json& header, const MomentArrays& arrays) {
  std::string text = header.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  return deflated(bytes + text + arrays.bytes());
}

}  // namespace brisance
