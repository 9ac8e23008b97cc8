#include "render/materials.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "render/dielectric.h"

namespace brisance {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

}  // namespace

Vec3f SurfaceMaterial::diffuseColour(const Vec2<float>& uv) const {
  return picture ? picture->at(uv.x, uv.y) : std::get<SolidColour>(settings.diffuse).colour;
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

Vec3f phongShare(const PhongPoint& point, const Vec3f& toLight) {
  const float facing = dot(point.normal, toLight);
  if (facing <= 0) return {};
  const float mirrored = -dot(point.toViewer, reflected(toLight, point.normal));
  if (mirrored <= 0 || point.specular == Vec3f{}) return point.diffuse * facing;
  return point.diffuse * facing + point.specular * std::pow(mirrored, point.exponent);
}

}  // namespace brisance
