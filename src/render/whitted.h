// The ray tracer (appendix A.1; Whitted 1980): light along a ray, with mirror and glass rays traced on.
#pragma once

#include <span>
#include <vector>

#include "render/camera_rays.h"
#include "render/environment.h"
#include "render/gas_medium.h"
#include "render/lights.h"
#include "render/scene_geometry.h"

namespace brisance {

/// All that a ray may meet. What lies beyond the last surface, and beyond `maxDepth` mirrors and glass surfaces, is
/// `background`.
struct RayWorld {
  const SceneGeometry& geometry;
  const MaterialTable& materials;
  const std::vector<LightSource>& lights;
  const GasMedium* gas;  ///< or none
  const Environment& background;
  Vec3f ambientLight;
  int maxDepth;
};

/// Light that arrives at the origin of a ray, scene-linear. `phase` (0 .. 1) shifts the samples taken in the gas.
Vec3f radiance(const RayWorld& world, const Ray& ray, float phase);
/// The same for a packet of rays, at most SceneGeometry::packet.
void radiance(const RayWorld& world, std::span<const CameraRay> rays, std::span<Vec3f> light);

}  // namespace brisance
