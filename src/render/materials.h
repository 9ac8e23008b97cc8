// Materials as the tracer looks at them: found by name once, their textures at hand.
#pragma once

#include <string>
#include <vector>

#include "frame/frame.h"
#include "render/textures.h"

namespace brisance {

/// A material and the picture that its diffuse colour may come from.
struct SurfaceMaterial {
  Material settings;
  const PictureTexture* picture = nullptr;

  Vec3f diffuseColour(const Vec2<float>& uv) const;
};

/// The materials of a picture by number; numbers are smaller than 2^16.
class MaterialTable {
 public:
  MaterialTable(const RenderSettings& settings, const TextureLibrary& textures);
  const SurfaceMaterial& operator[](std::size_t number) const { return materials_[number]; }
  /// The number of each triangle's material: the triangle's own where the mesh names one that the settings know, else
  /// the body's. One entry for all when the mesh has no materials of its own. Throws InputError naming body and
  /// material.
  std::vector<std::uint16_t> ofTriangles(const FrameBody& body) const;

 private:
  std::uint16_t ofBody(const FrameBody& body) const;
  std::vector<std::string> names_;  ///< in order of the alphabet
  std::vector<SurfaceMaterial> materials_;
};

/// What Phong's model needs to know of a place on a surface.
struct PhongPoint {
  Vec3f normal;    ///< facing the viewer
  Vec3f toViewer;  ///< unit
  Vec3f diffuse;   ///< R_d times the diffuse colour
  Vec3f specular;  ///< R_s
  float exponent;  ///< f
};
/// Light returned to the viewer of light 1 that arrives from unit direction `toLight` (appendix A.1.2, its cosines
/// clamped).
Vec3f phongShare(const PhongPoint& point, const Vec3f& toLight);

}  // namespace brisance
