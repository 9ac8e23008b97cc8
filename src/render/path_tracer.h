// All ways of light (Kajiya 1986): paths from the camera over surfaces, glass and gas, with the lights drawn at each
// bounce.
#pragma once

#include <span>

#include "render/area_lights.h"
#include "render/camera_rays.h"
#include "render/environment.h"
#include "render/fire_directions.h"
#include "render/gas_medium.h"
#include "render/lights.h"
#include "render/sample_sequence.h"
#include "render/scene_geometry.h"

namespace brisance {

/// All that a path may meet.
struct PathWorld {
  const SceneGeometry& geometry;
  const MaterialTable& materials;
  const std::vector<LightSource>& lights;  ///< points and suns
  const AreaLights& shining;
  const Environment& environment;
  const GasMedium* gas;        ///< or none
  const FireDirections* fire;  ///< of the gas, or none
  Vec3f smokeAlbedo;           ///< what gas scatters of the light that it stops
  float anisotropy;
  PathIntegrator settings;
  int maxDepth;  ///< mirrors and smooth glass surfaces of a path
};

/// An estimate of the light that arrives at the origin of a ray, scene-linear; its mean over samples is the light.
/// `phase` (0 .. 1) shifts the samples taken in the gas.
Vec3f pathRadiance(const PathWorld& world, const Ray& ray, float phase, SampleSequence& numbers);
/// The same for a packet of rays, at most SceneGeometry::packet.
void pathRadiance(const PathWorld& world, std::span<CameraRay> rays, std::span<Vec3f> light);

}  // namespace brisance
