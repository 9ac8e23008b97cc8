#include "export_looks.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

double largest(const Vec3f& v) { return std::max({v.x, v.y, v.z}); }

/// A highlight of Phong's exponent f is as wide as Beckmann's of roughness sqrt(2 / (f + 2)) (Walter et al. 2007,
/// section 5), of which glTF and UsdPreviewSurface store the square root.
double roughnessOf(const Material& material) {
  if (material.glass || largest(material.reflection) > 0) return 0;
  if (largest(material.specular) <= 0) return 1;
  return std::pow(2 / (material.specularExponent + 2), 0.25);
}

SurfaceLook lookOf(const Material& material) {
  SurfaceLook look;
  const auto weight = static_cast<float>(material.diffuseWeight);
  look.colour = Vec3f(1, 1, 1) * weight;
  look.emission = material.emission;
  if (const auto* picture = std::get_if<ImageTexture>(&material.diffuse)) {
    look.picture = picture->file;
  } else {
    const Vec3f& colour = std::get<SolidColour>(material.diffuse).colour;
    look.colour = colour * weight;
    look.emission = material.emission * colour;
  }
  look.metallic = std::min(largest(material.reflection), 1.0);
  if (look.metallic > 0) look.colour = min(look.colour + material.reflection, Vec3f(1, 1, 1));
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
