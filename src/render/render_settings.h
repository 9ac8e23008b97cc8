// All that a picture is told.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/math.h"

namespace brisance {

/// The camera at one time; between keys all values go smoothly (Catmull-Rom), before and after the nearest key holds.
struct CameraKey {
  double time = 0;  ///< [s] of film
  Vec3d position{0, 0, 5}, lookAt, up{0, 1, 0};
  double fovDegrees = 40;    ///< vertical; from focal_length_mm and sensor_height_mm where those are given
  double lensRadius = 0;     ///< [m] of a thin lens; 0: a pinhole
  double focusDistance = 5;  ///< [m] along the view, where a lens draws sharply
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
/// Patterns computed from the place in the body's own coordinates (appendix A.1.3); `unit` [m] is one unit of the
/// thesis' formulas.
struct Wood {
  Vec3f colour1{0.35f, 0.16f, 0.06f}, colour2{0.62f, 0.36f, 0.16f};
  double unit = 1;
};
struct Marble {
  Vec3f colour1{0.85f, 0.83f, 0.78f}, colour2{0.16f, 0.18f, 0.22f};
  double unit = 1;
};
/// A checkerboard of u and v.
struct Checkerboard {
  Vec3f colour1{0.8f, 0.8f, 0.8f}, colour2{0.1f, 0.1f, 0.1f};
  double size = 8;  ///< SIZE: fields over a texture's width
};
using Texture = std::variant<SolidColour, ImageTexture, Wood, Marble, Checkerboard>;

struct PhongLighting {};
/// Ashikhmin and Shirley's anisotropic model (appendix A.1.2).
struct AshikhminLighting {
  double exponentU = 100, exponentV = 100;  ///< n_u, n_v: the larger, the narrower the highlight along u, v
};
using LightingModel = std::variant<PhongLighting, AshikhminLighting>;

/// A lighting model (appendix A.1.2), plus perfect mirror and glass.
struct Material {
  Texture diffuse;
  LightingModel lighting;
  double diffuseWeight = 1;      ///< R_d
  Vec3f specular{0, 0, 0};       ///< R_s
  double specularExponent = 50;  ///< f of Phong's model
  Vec3f ambient{1, 1, 1};        ///< R_a times the diffuse colour
  Vec3f emission{0, 0, 0};       ///< times the diffuse texture: a lit picture
  Vec3f reflection{0, 0, 0};     ///< perfect mirror share of an opaque surface
  bool glass = false;            ///< dielectric: exact Fresnel shares of reflection and refraction
  double refractiveIndex = 1.5;
  double roughness = 0;       ///< alpha of GGX: slope of the glass surface's microscopic waves (path integrator)
  Vec3f absorption{0, 0, 0};  ///< [1/m] inside glass
  bool smooth = false;        ///< Phong shading: normals between vertices
  bool castsShadow = true;
  double pieceTint = 0;  ///< how far the hues of pieces lie apart: 0 all alike .. 1
  double glow = 0;       ///< times the blackbody colour of a body's temperature: what it shines with
};

struct PointLight {
  Vec3d position;
  Vec3f intensity{1, 1, 1};  ///< radiance at one metre
  double falloff = 2;        ///< 0: none (the thesis' Phong lights), 2: inverse square
};
struct SunLight {
  Vec3d direction{0, -1, 0};  ///< the way the light travels
  Vec3f radiance{1, 1, 1};
  double angleDegrees = 0.53;  ///< across; the path integrator draws the half-shadow that follows from it
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

/// What the drawn gas is made from: the particles over a fine grid, or the cells of the gas itself.
enum class VolumeSource { particles, gas };

/// The gas as the picture shows it (appendix A.2).
struct VolumeSettings {
  bool drawn = true;
  VolumeSource source = VolumeSource::particles;
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
  Vec3f smokeColour{.03f, .03f, .03f};  ///< what smoke scatters of the light that meets it
  double anisotropy = 0;                ///< mean cosine of the scattering angle (path integrator)
};

/// The gas' velocity drawn as arrows in a box, which may be flat.
struct FlowSettings {
  bool drawn = false;
  Vec3d lower, upper{1, 1, 1};  ///< [m] corners
  double spacing = 0.1;         ///< [m] between arrows
  double seconds = 0.05;        ///< [s] of the gas' way that an arrow is long
  Vec3f colour{.03f, .1f, .35f};
};

/// How sparks and dust are drawn.
struct BitsLook {
  double sparkWidth = 0.006;    ///< [m] of a streak at its middle
  double sparkSeconds = 0.005;  ///< [s] of the spark's way that its streak is long
  double sparkEmission = 6;     ///< times the blackbody colour of its temperature
  double grainSize = 0.005;     ///< [m] across
  Vec3f grainColour{.35f, .37f, .36f};
  Vec3f grainReflection{.4f, .4f, .4f};
};

/// Light from far away: a picture of all directions.
struct EnvironmentSettings {
  std::optional<std::filesystem::path>
      file;  ///< OpenEXR, PNG or JPEG, longitude across, latitude down; else background
  double strength = 1;
  double rotationDegrees = 0;  ///< about the y axis
};

/// How light is followed: rays to lights, mirrors and through glass (Whitted), or all ways that light takes.
struct WhittedIntegrator {};
struct PathIntegrator {
  int maxBounces = 12;   ///< off surfaces and smoke
  double faint = 0.01;   ///< share of a path's light that reaches the camera under which it may end by chance
  int splits = 2;        ///< glass surfaces and mirrors from the camera on at which both ways are followed
  bool adaptive = true;  ///< more samples for pixels whose light varies more
};
using Integrator = std::variant<WhittedIntegrator, PathIntegrator>;

struct RenderSettings {
  int width = 480, height = 360;
  double samples = 2;  ///< n of the n x n samples of a pixel; need not be whole where they go by noise
  int maxDepth = 8;    ///< of reflection and refraction
  Integrator integrator;
  EnvironmentSettings environment;
  std::uint64_t seed = 1;
  Vec3f background{0.5f, 0.6f, 0.7f};
  Vec3f ambientLight{.1f, .1f, .1f};
  double exposureStops = 0;
  bool writeExr = true;
  bool denoise = false;  ///< take the noise of chance from the picture
  bool layers = true;    ///< in the OpenEXR file: depth, normal, bodies ...
  CameraSettings camera;
  std::vector<Light> lights;
  std::map<std::string, Material> materials;
  VolumeSettings volume;
  FlowSettings flow;
  BitsLook bits;
};

/// Whether pixels get samples by how much their light varies, instead of each the same.
inline bool samplesGoByNoise(const RenderSettings& settings) {
  const auto* paths = std::get_if<PathIntegrator>(&settings.integrator);
  return paths != nullptr && paths->adaptive && settings.samples > 1 && !settings.denoise;
}

}  // namespace brisance
