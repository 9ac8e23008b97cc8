// Materials as the tracer looks at them: found by name once, their textures at hand.
#pragma once

#include <string>
#include <vector>

#include "frame/frame.h"
#include "render/scattering.h"
#include "render/textures.h"

namespace brisance {

/// A material and the picture that its diffuse colour may come from.
struct SurfaceMaterial {
  Material settings;
  const PictureTexture* picture = nullptr;

  Vec3f diffuseColour(const TexturePlace& place) const;
  /// The mean of diffuseColour over a picture, or an example of it.
  Vec3f typicalColour() const;
  /// Whether hits have to know where in the body they are, and which way u goes.
  bool isSolidPattern() const;
  bool isAnisotropic() const;
  /// What an opaque surface is, a perfect mirror's share apart.
  SurfaceScattering opaque(const TexturePlace& place) const;
  /// What a surface of glass is to light that comes from outside, or from inside.
  SurfaceScattering glass(bool fromInside) const;
};

/// The materials of a picture by number; numbers are smaller than 2^16.
class MaterialTable {
 public:
  MaterialTable(const RenderSettings& settings, const TextureLibrary& textures);
  std::size_t size() const { return materials_.size(); }
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

}  // namespace brisance
