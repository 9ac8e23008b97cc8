// Picture files laid over surfaces.
#pragma once

#include <filesystem>
#include <map>

#include "render/image.h"
#include "render/render_settings.h"

namespace brisance {

/// A picture in linear light, repeated over the plane; (0, 0) is the lower left corner of the picture, u to the right,
/// v up.
class PictureTexture {
 public:
  explicit PictureTexture(Picture picture) : picture_(std::move(picture)) {}
  /// Bilinear between the centres of the pixels, in linear light.
  Vec3f at(double u, double v) const;
  Vec3f mean() const;

 private:
  Vec3f texel(int column, int row) const;
  Picture picture_;
};

/// Where on a surface a texture is looked up.
struct TexturePlace {
  Vec2<float> uv;
  Vec3f inBody;  ///< [m] in the body's own coordinates
};

// Patterns of appendix A.1.3.
Vec3f patternColour(const Wood& wood, const TexturePlace& place);
Vec3f patternColour(const Marble& marble, const TexturePlace& place);
Vec3f patternColour(const Checkerboard& board, const TexturePlace& place);

/// Textures by file, each read once.
class TextureLibrary {
 public:
  /// Throws InputError naming `material` when the file cannot be found, DamagedFile when it is no whole PNG or JPEG.
  void load(const std::filesystem::path& file, const std::string& material);
  /// The texture of a file that was loaded.
  const PictureTexture& at(const std::filesystem::path& file) const;

 private:
  std::map<std::filesystem::path, PictureTexture> textures_;
};

}  // namespace brisance
