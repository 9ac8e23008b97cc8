// Bodies and materials that the tests of the tracer draw.
#pragma once

#include <memory>

#include "frame/frame.h"
#include "mesh/shapes.h"
#include "render/render_frame.h"
#include "render/scene_geometry.h"

namespace brisance {

inline FrameBody bodyOf(const std::string& name, TriangleMesh mesh, const std::string& material,
                        const Pose& pose = {}) {
  FrameBody body;
  body.name = name;
  body.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  body.material = material;
  body.pose = pose;
  return body;
}

/// A surface that shines and returns no light.
inline Material lamp(const Vec3f& light) {
  Material material;
  material.diffuse = SolidColour{{1, 1, 1}};
  material.diffuseWeight = 0;
  material.ambient = {0, 0, 0};
  material.emission = light;
  return material;
}

inline Material clearGlass(bool smooth = false) {
  Material material;
  material.glass = true;
  material.smooth = smooth;
  return material;
}

/// A white surface lit by nothing but the lights.
inline Material whitePaint() {
  Material material;
  material.diffuse = SolidColour{{1, 1, 1}};
  material.ambient = {0, 0, 0};
  return material;
}

/// 32 x 32 pixels seen from `distance` [m] on the z axis towards the origin, against black.
inline RenderSettings smallPicture(double distance = 5) {
  RenderSettings settings;
  settings.width = settings.height = 32;
  settings.background = settings.ambientLight = {0, 0, 0};
  settings.camera.keys = {{0, {0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 40}};
  settings.volume.drawn = false;
  return settings;
}

/// A frame's bodies with all that a ray needs to meet them.
class SmallWorld {
 public:
  SmallWorld(std::vector<FrameBody> bodies, std::map<std::string, Material> materials) : bodies_(std::move(bodies)) {
    settings_.materials = std::move(materials);
    table_ = std::make_unique<MaterialTable>(settings_, textures_);
    geometry_ = std::make_unique<SceneGeometry>(bodies_, *table_, 0);
  }
  const SceneGeometry& geometry() const { return *geometry_; }
  const MaterialTable& materials() const { return *table_; }

 private:
  std::vector<FrameBody> bodies_;
  RenderSettings settings_;
  TextureLibrary textures_;
  std::unique_ptr<MaterialTable> table_;
  std::unique_ptr<SceneGeometry> geometry_;
};

}  // namespace brisance
