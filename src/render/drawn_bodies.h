// What is looked up about a body where a ray meets it.
#pragma once

#include "render/scene_geometry.h"

namespace brisance {

struct DrawnBody {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<std::uint16_t> materials;  ///< one, or one per triangle
  std::vector<Vec3d> normals;            ///< of vertices where the mesh has none and a material is smooth
  Mat3 rotation;

  std::uint16_t material(std::uint32_t triangle) const {
    return materials.size() == 1 ? materials[0] : materials[triangle];
  }
  const std::vector<Vec3d>& smoothNormals() const { return normals.empty() ? mesh->normals : normals; }
};

/// The bodies of a picture by number.
class DrawnBodies {
 public:
  explicit DrawnBodies(const MaterialTable& materials) : materials_(materials) {}
  void add(const FrameBody& body);
  std::uint32_t size() const { return static_cast<std::uint32_t>(drawn_.size()); }
  /// Whether there is glass, or a material that casts no shadow.
  bool anyLetsLightPass() const { return anyLetsLightPass_; }
  std::uint16_t material(std::uint32_t body, std::uint32_t triangle) const { return drawn_[body].material(triangle); }
  const Material& settings(std::uint32_t body, std::uint32_t triangle) const {
    return materials_[material(body, triangle)].settings;
  }
  SurfaceHit surfaceAt(const FoundTriangle& found) const;

 private:
  const MaterialTable& materials_;
  std::vector<DrawnBody> drawn_;
  bool anyLetsLightPass_ = false;
};

}  // namespace brisance
