#include "export_looks.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

double largest(const Vec3f& v) { return std::max({v.x, v.y, v.z}); }

Vec3f colourOf(const SolidColour& texture) { return texture.colour; }
/// The picture has the colours.
Vec3f colourOf(const ImageTexture&) { return {1, 1, 1}; }
/// Patterns are computed, which no file format here knows: what one sees of them from afar.
template <class Pattern>
Vec3f colourOf(const Pattern& pattern) {
  return (pattern.colour1 + pattern.colour2) * 0.5f;
}

double exponentOf(const Material& material) {
  if (const auto* model = std::get_if<AshikhminLighting>(&material.lighting))
    return std::sqrt(model->exponentU * model->exponentV);
  return material.specularExponent;
}

/// The formats store the square root of the microscopic slopes' alpha. A highlight cos^f is as wide as Beckmann's of
/// alpha = sqrt(2 / (f + 2)) (Walter et al. 2007, section 5.2).
double roughnessOf(const Material& material) {
  if (material.glass) return std::min(std::sqrt(material.roughness), 1.0);
  if (largest(material.reflection) > 0) return 0;
  if (largest(material.specular) <= 0) return 1;
  return std::pow(2 / (exponentOf(material) + 2), 0.25);
}

SurfaceLook lookOf(const Material& material) {
  const Vec3f texture = std::visit([](const auto& kind) { return colourOf(kind); }, material.diffuse);
  SurfaceLook look;
  if (const auto* picture = std::get_if<ImageTexture>(&material.diffuse)) look.picture = picture->file;
  look.emission = material.emission * texture;
  look.metallic = std::min(largest(material.reflection), 1.0);
  look.colour = texture * static_cast<float>(material.diffuseWeight) + material.reflection;
  look.roughness = roughnessOf(material);
  look.glass = material.glass;
  look.refractiveIndex = material.refractiveIndex;
  // What passes through a glTF's glass takes on its base colour: clear.
  if (look.glass) look.colour = {1, 1, 1};
  look.colour = min(look.colour, Vec3f(1, 1, 1));
  return look;
}

}  // namespace

SurfaceLooks looksOf(const RenderSettings& settings) {
  SurfaceLooks looks;
  for (const auto& [name, material] : settings.materials) looks.emplace(name, lookOf(material));
  return looks;
}

}  // namespace brisance
