// The lights of a picture, whatever they came from, as what arrives at a place.
#pragma once

#include <limits>
#include <vector>

#include "render/fire_lights.h"

namespace brisance {

struct ArrivingLight {
  Vec3f toLight;    ///< unit
  float distance;   ///< [m] to the light
  Vec3f intensity;  ///< I_s of Phong's model: what a white diffuse surface facing the light returns
};

/// A light ready to shine.
struct LightSource {
  enum class Kind { point, sun, fire };
  Kind kind;
  Vec3f place;        ///< [m], or for a sun the unit direction towards it
  Vec3f intensity;    ///< I_s: of a sun anywhere, of the others at one metre
  float falloff = 0;  ///< power of the distance
  float radius = 0;   ///< [m] softens the inverse square near a light that is no point
  float cosine = 1;   ///< of half the angle across a sun

  ArrivingLight at(const Vec3f& place) const;
  /// From a place of the sun's disc, `where` uniform in 0 .. 1 both ways.
  ArrivingLight at(const Vec3f& place, const Vec2<float>& where) const;
  /// The radiance of a sun's disc in a direction: its irradiance over its solid angle.
  Vec3f discSeenAlong(const Vec3f& direction) const;
};

/// All lights of the settings; FireLight becomes the fire points of `gas` (none when there is no gas). I_s of a fire
/// point is its intensity over pi, since Phong's I_s is irradiance over pi.
std::vector<LightSource> lightSources(const std::vector<Light>& lights, const GasMedium* gas);

}  // namespace brisance
