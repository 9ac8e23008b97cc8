// Materials of a glTF: base colour, roughness, glow, glass; pictures inside the file.
#include <algorithm>

#include "base/check.h"
#include "base/durable_file.h"
#include "frame/gltf_writer.h"

namespace brisance::gltf {

namespace {

Json colour(const Vec3f& c) { return {c.x, c.y, c.z}; }

/// By the bytes with which PNG files begin; all other pictures of a scene are JPEG.
const char* mimeType(const std::string& bytes) { return bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg"; }

}  // namespace

int GlbWriter::materialNumber(const FrameBody& body, const std::string& part) {
  const NamedLook named =
      looks_ ? lookOf(*looks_, body, part) : NamedLook{part.empty() ? body.material : part, SurfaceLook{}};
  const auto known = materialNumbers_.find(named.name);
  if (known != materialNumbers_.end()) return known->second;
  Json material =
      looks_ ? describe(named) : Json{{"name", named.name}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}};
  materials_.push_back(std::move(material));
  return materialNumbers_[named.name] = static_cast<int>(materials_.size()) - 1;
}

/// Both sides are drawn: shells have an inside that is seen.
Json GlbWriter::describe(const NamedLook& named) {
  const SurfaceLook& look = named.look;
  const Json texture = look.picture.empty() ? Json() : pictureTexture(look.picture);
  Json surface{{"baseColorFactor", {look.colour.x, look.colour.y, look.colour.z, 1}},
               {"metallicFactor", look.metallic},
               {"roughnessFactor", look.roughness}};
  if (!texture.is_null()) surface["baseColorTexture"] = texture;
  Json material{{"name", named.name}, {"pbrMetallicRoughness", std::move(surface)}, {"doubleSided", true}};
  describeGlow(look, texture, material);
  if (!look.glass) return material;
  useExtension(material, "KHR_materials_transmission", {{"transmissionFactor", 1}});
  useExtension(material, "KHR_materials_ior", {{"ior", look.refractiveIndex}});
  return material;
}

/// An emissive factor ends at 1; what is brighter says so in an extension.
void GlbWriter::describeGlow(const SurfaceLook& look, const Json& texture, Json& material) {
  const float strength = std::max({look.emission.x, look.emission.y, look.emission.z});
  if (strength <= 0) return;
  material["emissiveFactor"] = colour(look.emission / std::max(strength, 1.f));
  if (!texture.is_null()) material["emissiveTexture"] = texture;
  if (strength > 1) useExtension(material, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
}

Json GlbWriter::pictureTexture(const std::filesystem::path& picture) {
  const auto [place, isNew] = textureNumbers_.try_emplace(picture, static_cast<int>(textures_.size()));
  if (isNew) {
    const std::string bytes = readFile(picture);
    images_.push_back({{"bufferView", addView(bytes.data(), bytes.size(), 0)}, {"mimeType", mimeType(bytes)}});
    textures_.push_back({{"source", images_.size() - 1}});
  }
  return {{"index", place->second}};
}

void GlbWriter::useExtension(Json& material, const char* name, Json content) {
  material["extensions"][name] = std::move(content);
  extensions_.insert(name);
}

}  // namespace brisance::gltf
