#include "render/textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/durable_file.h"
#include "render/noise.h"
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

/// Where between two pixel centres a coordinate falls.
struct Between {
  int first, second;  ///< pixels
  float share;        ///< of the second
};
/// `share` 0 .. 1 of the picture's width or height, which the picture repeats itself over.
Between between(double share, int n) {
  const double pixels = share * n + (n - 0.5);  // positive: a picture further
  const int first = static_cast<int>(pixels);
  const int inside = first >= n ? std::min(first - n, n - 1) : first;
  return {inside, inside + 1 == n ? 0 : inside + 1, static_cast<float>(pixels - first)};
}

Vec3f mixed(const Vec3f& a, const Vec3f& b, double share) {
  const auto s = static_cast<float>(share);
  return a * (1 - s) + b * s;
}

}  // namespace

Vec3f PictureTexture::texel(int column, int row) const {
  const std::uint8_t* code = &picture_.rgb[3 * (static_cast<std::size_t>(row) * picture_.width + column)];
  const auto& linear = linearOfCode();
  return {linear[code[0]], linear[code[1]], linear[code[2]]};
}

Vec3f PictureTexture::at(double u, double v) const {
  const Between x = between(u - std::floor(u), picture_.width);
  const double down = 1 - v;  // rows count from the top, v from the bottom
  const Between y = between(down - std::floor(down), picture_.height);
  const auto line = [&](int row) { return texel(x.first, row) * (1 - x.share) + texel(x.second, row) * x.share; };
  return line(y.first) * (1 - y.share) + line(y.second) * y.share;
}

Vec3f PictureTexture::mean() const {
  Vec3d sum;
  for (int row = 0; row < picture_.height; ++row)
    for (int column = 0; column < picture_.width; ++column) sum += Vec3d(texel(column, row));
  return Vec3f(sum / (static_cast<double>(picture_.width) * picture_.height));
}

/// Rings where the noise passes a whole number. int() of the thesis is floor: it differs below zero, where the noise of
/// weight 20 rarely is.
Vec3f patternColour(const Wood& wood, const TexturePlace& place) {
  constexpr NoiseHarmonics harmonics{2, 1.2, 8};
  const double noise = (1 + harmonicNoise(Vec3d(place.inBody) / wood.unit, harmonics) / 2) * 20;
  return mixed(wood.colour1, wood.colour2, noise - std::floor(noise));
}

/// Veins across x, one for each 1.7 units; the sine's argument is in radians: in degrees a vein would be a hundred
/// units wide.
Vec3f patternColour(const Marble& marble, const TexturePlace& place) {
  constexpr NoiseHarmonics harmonics{2, 2, 8};
  const Vec3d p = Vec3d(place.inBody) / marble.unit;
  const double noise = std::abs(std::sin(180 * (0.01 * p.x + 0.02 * harmonicNoise(p, harmonics))));
  return mixed(marble.colour2, marble.colour1, noise);
}

Vec3f patternColour(const Checkerboard& board, const TexturePlace& place) {
  const auto field = [&](float coordinate) { return static_cast<std::int64_t>(std::floor(board.size * coordinate)); };
  return (field(place.uv.x) - field(place.uv.y)) % 2 == 0 ? board.colour1 : board.colour2;
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
