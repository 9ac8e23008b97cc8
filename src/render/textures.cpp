#include "render/textures.h"

#include <array>
#include <cmath>

#include "base/check.h"
#include "base/durable_file.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

/// Linear light of each 8-bit sRGB code.
const std::array<float, 256>& linearOfCode() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t code = 0; code < values.size(); ++code) values[code] = srgbDecoded(static_cast<float>(code) / 255);
    return values;
  }();
  return table;
}

int wrapped(std::int64_t i, int n) {
  const auto rest = static_cast<int>(i % n);
  return rest < 0 ? rest + n : rest;
}

/// Where between two pixel centres a coordinate falls.
struct Between {
  int first, second;  ///< pixels
  float share;        ///< of the second
};
Between between(double pixels, int n) {
  const double from = std::floor(pixels - 0.5);
  const auto i = static_cast<std::int64_t>(from);
  return {wrapped(i, n), wrapped(i + 1, n), static_cast<float>(pixels - 0.5 - from)};
}

}  // namespace

Vec3f PictureTexture::texel(int column, int row) const {
  const std::uint8_t* code = &picture_.rgb[3 * (static_cast<std::size_t>(row) * picture_.width + column)];
  const auto& linear = linearOfCode();
  return {linear[code[0]], linear[code[1]], linear[code[2]]};
}

Vec3f PictureTexture::at(double u, double v) const {
  const Between x = between((u - std::floor(u)) * picture_.width, picture_.width);
  const double down = 1 - v;  // rows count from the top, v from the bottom
  const Between y = between((down - std::floor(down)) * picture_.height, picture_.height);
  const auto line = [&](int row) { return texel(x.first, row) * (1 - x.share) + texel(x.second, row) * x.share; };
  return line(y.first) * (1 - y.share) + line(y.second) * y.share;
}

void TextureLibrary::load(const std::filesystem::path& file, const std::string& material) {
  if (textures_.contains(file)) return;
  std::error_code trouble;
  if (!std::filesystem::is_regular_file(file, trouble))
    throw InputError(fmt::format("material \"{}\": texture {} does not exist; a PNG or JPEG file is wanted", material,
                                 file.string()));
  textures_.emplace(file, PictureTexture(decodePicture(readFile(file), file.string())));
}

const PictureTexture& TextureLibrary::at(const std::filesystem::path& file) const {
  const auto found = textures_.find(file);
  CHECK(found != textures_.end(), "texture {} was never loaded", file.string());
  return found->second;
}

}  // namespace brisance
