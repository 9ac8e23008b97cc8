#include "render/materials.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace brisance {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

Vec3f colourOf(const SolidColour& solid, const TexturePlace&) { return solid.colour; }
Vec3f colourOf(const ImageTexture&, const TexturePlace&) { return {}; }  // its picture knows
template <class Pattern>
Vec3f colourOf(const Pattern& pattern, const TexturePlace& place) {
  return patternColour(pattern, place);
}

}  // namespace

Vec3f SurfaceMaterial::diffuseColour(const TexturePlace& place) const {
  if (picture) return picture->at(place.uv.x, place.uv.y);
  return std::visit([&](const auto& texture) { return colourOf(texture, place); }, settings.diffuse);
}

Vec3f SurfaceMaterial::typicalColour() const { return picture ? picture->mean() : diffuseColour({}); }

bool SurfaceMaterial::isSolidPattern() const {
  return std::holds_alternative<Wood>(settings.diffuse) || std::holds_alternative<Marble>(settings.diffuse);
}

bool SurfaceMaterial::isAnisotropic() const {
  const auto* model = std::get_if<AshikhminLighting>(&settings.lighting);
  return model && model->exponentU != model->exponentV;
}

SurfaceScattering SurfaceMaterial::opaque(const TexturePlace& place) const {
  const Vec3f diffuse = diffuseColour(place) * static_cast<float>(settings.diffuseWeight);
  if (const auto* model = std::get_if<AshikhminLighting>(&settings.lighting))
    return AshikhminShirley{diffuse, settings.specular, static_cast<float>(model->exponentU),
                            static_cast<float>(model->exponentV)};
  if (settings.specular == Vec3f{}) return Lambert{diffuse};
  return Phong{diffuse, settings.specular, static_cast<float>(settings.specularExponent)};
}

SurfaceScattering SurfaceMaterial::glass(bool fromInside) const {
  constexpr double hardlyBends = 1e-3;  // of the index: a rough surface of such glass has no half vectors
  const double index = settings.refractiveIndex;
  const auto ratio = static_cast<float>(fromInside ? index : 1 / index);
  if (settings.roughness == 0 || index - 1 < hardlyBends) return SmoothDielectric{ratio};
  return RoughDielectric{ratio, static_cast<float>(settings.roughness)};
}

MaterialTable::MaterialTable(const RenderSettings& settings, const TextureLibrary& textures) {
  for (const auto& [name, material] : settings.materials) {
    names_.push_back(name);
    const auto* image = std::get_if<ImageTexture>(&material.diffuse);
    materials_.push_back({material, image ? &textures.at(image->file) : nullptr});
  }
}

std::uint16_t MaterialTable::ofBody(const FrameBody& body) const {
  const auto found = std::lower_bound(names_.begin(), names_.end(), body.material);
  if (found == names_.end() || *found != body.material)
    throw InputError(fmt::format("body \"{}\": material \"{}\" is not defined; defined are: {}", body.name,
                                 body.material, listed(names_)));
  return static_cast<std::uint16_t>(found - names_.begin());
}

std::vector<std::uint16_t> MaterialTable::ofTriangles(const FrameBody& body) const {
  const TriangleMesh& mesh = *body.mesh;
  std::vector<std::uint16_t> ofName;
  for (const std::string& name : mesh.materialNames) {
    const auto found = std::lower_bound(names_.begin(), names_.end(), name);
    const bool known = found != names_.end() && *found == name;
    ofName.push_back(known ? static_cast<std::uint16_t>(found - names_.begin()) : ofBody(body));
  }
  if (mesh.materials.empty() || ofName.empty()) return {ofBody(body)};
  std::vector<std::uint16_t> numbers;
  numbers.reserve(mesh.materials.size());
  for (const std::uint16_t name : mesh.materials) numbers.push_back(ofName.at(name));
  return numbers;
}

}  // namespace brisance
