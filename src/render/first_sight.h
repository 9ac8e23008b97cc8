// What a ray from the camera sees that no chance decides: the first surface, the gas before it, and what shows through
// clear glass and in mirrors.
#pragma once

#include "render/environment.h"
#include "render/gas_medium.h"
#include "render/lights.h"
#include "render/scene_geometry.h"

namespace brisance {

/// All that such a ray may meet.
struct SightWorld {
  const SceneGeometry& geometry;
  const MaterialTable& materials;
  const std::vector<LightSource>& lights;
  const Environment& environment;
  const GasMedium* gas;  ///< or none
  Vec3f smokeAlbedo;
  PathIntegrator settings;
  int maxDepth;  ///< mirrors and smooth glass surfaces
};

struct Sight {
  bool found = false;          ///< a surface at all
  SurfaceHit first;            ///< the nearest one, of glass or not
  Vec3f gasLight;              ///< what the gas before it sends
  float gasTransmittance = 1;  ///< and lets through

  // Along the way through glass (not what is mirrored in it) and in mirrors, as far as the first other surface:
  Vec3f certain;        ///< the part of the picture's light that all samples of this ray have in common
  Vec3f albedo;         ///< what is returned of light from all around, by surfaces and smoke, as it reaches the eye
  float clearness = 1;  ///< the share that reaches the eye from behind all glass and gas
  bool ends = false;    ///< at a surface, else far away
  Vec3f normal;         ///< of that surface, towards the ray
  float length = 0;     ///< [m] of the way
};

/// `phase` shifts the samples in the gas, as the integrators' do.
Sight firstSight(const SightWorld& world, const Ray& ray, float phase);

}  // namespace brisance
