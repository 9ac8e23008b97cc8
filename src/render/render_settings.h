// All that a picture is told.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/math.h"

namespace brisance {

/// The camera at one time; between keys all values go smoothly (Catmull-Rom), before and after the nearest key holds.
struct CameraKey {
  double time = 0;  ///< [s] of film
  Vec3d position{0, 0, 5}, lookAt, up{0, 1, 0};
  double fovDegrees = 40;  ///< vertical; from focal_length_mm and sensor_height_mm where those are given
};
struct CameraSettings {
  std::vector<CameraKey> keys;
  double shutter = 0;  ///< fraction of a frame the shutter is open
};

struct SolidColour {
  Vec3f colour{.7f, .7f, .7f};
};  ///< scene-linear
struct ImageTexture {
  std::filesystem::path file;
};  ///< PNG or JPEG, sRGB
using Texture = std::variant<SolidColour, ImageTexture>;

/// Phong's model (appendix A.1.2), plus perfect mirror and glass.
struct Material {
  Texture diffuse;
  double diffuseWeight = 1;      ///< R_d
  Vec3f specular{0, 0, 0};       ///< R_s
  double specularExponent = 50;  ///< f
  Vec3f ambient{1, 1, 1};        ///< R_a times the diffuse colour
  Vec3f emission{0, 0, 0};       ///< times the diffuse texture: a lit picture
  Vec3f reflection{0, 0, 0};     ///< perfect mirror share of an opaque surface
  bool glass = false;            ///< dielectric: exact Fresnel shares of reflection and refraction
  double refractiveIndex = 1.5;
  Vec3f absorption{0, 0, 0};  ///< [1/m] inside glass
  bool smooth = false;        ///< Phong shading: normals between vertices
  bool castsShadow = true;
};

struct PointLight {
  Vec3d position;
  Vec3f intensity{1, 1, 1};  ///< radiance at one metre
  double falloff = 2;        ///< 0: none (the thesis' Phong lights), 2: inverse square
};
struct SunLight {
  Vec3d direction{0, -1, 0};  ///< the way the light travels
  Vec3f radiance{1, 1, 1};
};
/// The burning gas as a few point lights found in each frame's volume, so that fire lights the walls.
struct FireLight {
  double strength = 1;  ///< 1: as bright as the fire is seen
  int lights = 8;
};
using Light = std::variant<PointLight, SunLight, FireLight>;

/// How temperature becomes colour.
struct PhysicalBlackbody {
  double exposureTemperature = 2000;
};                         ///< [K] whose luminance is 1
struct TunedBlackbody {};  ///< the thesis' 2P^2 + 100P + 1000
using BlackbodyMap = std::variant<PhysicalBlackbody, TunedBlackbody>;

/// The gas drawn from its particles (appendix A.2).
struct VolumeSettings {
  bool drawn = true;
  Vec3i cells{300, 300, 300};                 ///< vx x vy x vz
  Vec3d corner;                               ///< [m]
  double cellSize = 1.0 / 300;                ///< [m]
  double blur = 0.022;                        ///< alpha [m]
  int filterSize = 0;                         ///< nf; 0: three deviations
  double minDensity = 0.0, maxDensity = 1.0;  ///< min_d, max_d
  double fullDensity = 1.0;                   ///< [kg/m3] that is mapped to max_d: one range for the whole run
  double opacity = 100;                       ///< tau [1/m] per mapped density
  double fuelWeight = 1;                      ///< how much a burning fuel particle counts, times its mass
  BlackbodyMap blackbody;
  double emission = 1;                  ///< times the blackbody colour
  Vec3f smokeColour{.03f, .03f, .03f};  ///< what cold smoke scatters of the ambient light
};

struct RenderSettings {
  int width = 480, height = 360;
  int samples = 2;   ///< n of the n x n sub-pixels
  int maxDepth = 8;  ///< of reflection and refraction
  std::uint64_t seed = 1;
  Vec3f background{0.5f, 0.6f, 0.7f};
  Vec3f ambientLight{.1f, .1f, .1f};
  double exposureStops = 0;
  bool writeExr = true;
  CameraSettings camera;
  std::vector<Light> lights;
  std::map<std::string, Material> materials;
  VolumeSettings volume;
};

}  // namespace brisance
