#include "render/picture_file.h"

#include "render/decoders.h"

namespace brisance {

Picture emptyPicture(std::uint64_t width, std::uint64_t height, const std::string& fileName) {
  constexpr std::uint64_t mostPixels = std::uint64_t{1} << 28;  // 16384 x 16384: 0.8 GB decoded
  if (width == 0 || height == 0 || width > mostPixels || height > mostPixels || width * height > mostPixels)
    throw DamagedFile(
        fmt::format("{}: claims {} x {} pixels; accepted are up to 2^28 in all", fileName, width, height));
  return {static_cast<int>(width), static_cast<int>(height), std::vector<std::uint8_t>(3 * width * height)};
}

Picture decodePicture(const std::string& bytes, const std::string& fileName) {
  if (bytes.starts_with("\x89PNG")) return decodePng(bytes, fileName);
  if (bytes.starts_with("\xFF\xD8")) return decodeJpeg(bytes, fileName);
  throw DamagedFile(fmt::format("{}: neither PNG nor JPEG: its first bytes are of another kind", fileName));
}

}  // namespace brisance
