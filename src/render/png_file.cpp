#include <png.h>

#include "render/decoders.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

png_image emptyPng() {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  return png;
}

[[noreturn]] void reject(png_image& png, const std::string& fileName) {
  const std::string reason = png.message;
  png_image_free(&png);
  throw DamagedFile(fmt::format("{}: not a whole PNG picture: {}", fileName, reason));
}

}  // namespace

std::string encodePng(const Picture& picture) {
  png_image png = emptyPng();
  png.width = static_cast<png_uint_32>(picture.width);
  png.height = static_cast<png_uint_32>(picture.height);
  png.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  const int done = png_image_write_to_memory(&png, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr);
  CHECK(done, "PNG {} x {}: {}", picture.width, picture.height, png.message);
  bytes.resize(size);
  return bytes;
}

Picture decodePng(const std::string& bytes, const std::string& fileName) {
  png_image png = emptyPng();
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) reject(png, fileName);
  png.format = PNG_FORMAT_RGB;
  Picture picture = emptyPicture(png.width, png.height, fileName);
  const png_color black{0, 0, 0};
  if (!png_image_finish_read(&png, &black, picture.rgb.data(), 0, nullptr)) reject(png, fileName);
  return picture;
}

}  // namespace brisance
