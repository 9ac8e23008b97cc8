// What other programs are told of a material.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/math.h"
#include "frame/frame.h"

namespace brisance {

struct SurfaceLook {
  Vec3f colour{0.7f, 0.7f, 0.7f};  ///< scene-linear; with a picture what its colours are multiplied by
  std::filesystem::path picture;   ///< PNG or JPEG in sRGB, repeated; empty: none
  double roughness = 1;            ///< 0: a mirror
  double metallic = 0;
  Vec3f emission;  ///< scene-linear, times the picture
  bool glass = false;
  double refractiveIndex = 1.5;
};

/// By the names of a scene's materials.
using SurfaceLooks = std::map<std::string, SurfaceLook>;

/// The material of some triangles under the name that other programs see.
struct NamedLook {
  std::string name;
  SurfaceLook look;
};

/// Triangles of the mesh's material `part` (empty: the mesh names none) on a body. A part that the scene does not know
/// looks as its body does, and keeps a material of its own for an artist to change: "glass.inside".
inline NamedLook lookOf(const SurfaceLooks& looks, const FrameBody& body, const std::string& part) {
  if (const auto own = looks.find(part); own != looks.end()) return {part, own->second};
  const auto ofBody = looks.find(body.material);
  const SurfaceLook look = ofBody == looks.end() ? SurfaceLook{} : ofBody->second;
  if (part.empty()) return {body.material, look};
  return {body.material.empty() ? part : body.material + "." + part, look};
}

}  // namespace brisance
