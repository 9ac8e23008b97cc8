// How surfaces and smoke scatter light: one interface of value, density and sample over plain types.
//
// Directions are unit and local: z is the normal on the viewer's side, x goes along the texture's u, y along v. `out`
// goes to the viewer (out.z > 0), `in` to where the light comes from. Behind a refracting surface what is followed is
// radiance over the square of the refractive index, which refraction leaves unchanged.
#pragma once

#include <optional>
#include <variant>

#include "base/math.h"

namespace brisance {

/// Three random numbers in [0, 1): two for a direction, one for a choice.
struct ScatterDraw {
  float x, y, choice;
};

struct ScatterSample {
  Vec3f in;
  Vec3f weight;          ///< value times cosine over density
  float density = 0;     ///< of `in` [1/sr]; 0 for a single direction
  bool perfect = false;  ///< mirror or smooth glass: no light but the one in this direction counts
};

/// Every direction alike. `colour` is the albedo.
struct Lambert {
  Vec3f colour;
};
/// The thesis' Phong (appendix A.1.2): light of I_s returns I_s (R_d cos + R_s (V . R)^f). Neither reciprocal nor
/// bounded.
struct Phong {
  Vec3f diffuse, specular;
  float exponent;
};
/// Ashikhmin & Shirley 2000, "An anisotropic Phong BRDF model".
struct AshikhminShirley {
  Vec3f diffuse, specular;
  float exponentU, exponentV;
};
/// `ratio`: refractive index before the surface (the viewer's side) over that behind it.
struct SmoothDielectric {
  float ratio;
};
/// Walter, Marschner, Li & Torrance 2007, with the GGX distribution of slope alpha.
struct RoughDielectric {
  float ratio, alpha;
};
using SurfaceScattering = std::variant<Lambert, Phong, AshikhminShirley, SmoothDielectric, RoughDielectric>;

/// Value times the cosine of `in` [1/sr]; nothing for single directions.
Vec3f value(const SurfaceScattering& surface, const Vec3f& out, const Vec3f& in);
/// With which density [1/sr] sample() draws `in`.
float density(const SurfaceScattering& surface, const Vec3f& out, const Vec3f& in);
/// Nothing where the light would be absorbed.
std::optional<ScatterSample> sample(const SurfaceScattering& surface, const Vec3f& out, const ScatterDraw& draw);

/// The same for each kind alone.
Vec3f value(const Lambert&, const Vec3f& out, const Vec3f& in);
Vec3f value(const Phong&, const Vec3f& out, const Vec3f& in);
Vec3f value(const AshikhminShirley&, const Vec3f& out, const Vec3f& in);
Vec3f value(const SmoothDielectric&, const Vec3f& out, const Vec3f& in);
Vec3f value(const RoughDielectric&, const Vec3f& out, const Vec3f& in);
float density(const Lambert&, const Vec3f& out, const Vec3f& in);
float density(const Phong&, const Vec3f& out, const Vec3f& in);
float density(const AshikhminShirley&, const Vec3f& out, const Vec3f& in);
float density(const SmoothDielectric&, const Vec3f& out, const Vec3f& in);
float density(const RoughDielectric&, const Vec3f& out, const Vec3f& in);
std::optional<ScatterSample> sample(const Lambert&, const Vec3f& out, const ScatterDraw& draw);
std::optional<ScatterSample> sample(const Phong&, const Vec3f& out, const ScatterDraw& draw);
std::optional<ScatterSample> sample(const AshikhminShirley&, const Vec3f& out, const ScatterDraw& draw);
std::optional<ScatterSample> sample(const SmoothDielectric&, const Vec3f& out, const ScatterDraw& draw);
std::optional<ScatterSample> sample(const RoughDielectric&, const Vec3f& out, const ScatterDraw& draw);

/// Henyey & Greenstein 1941: smoke of mean scattering cosine `anisotropy`. `cosine` between the way on and the way
/// here; [1/sr], both value and density.
float phaseFunction(float anisotropy, float cosine);
/// The way on, drawn by the phase function; `onward` is the way here.
Vec3f samplePhase(float anisotropy, const Vec3f& onward, float x, float y);

/// Right-handed unit axes about a unit normal; x as near to `towards` as it can be (any direction where that is along
/// the normal or zero).
struct Axes {
  Vec3f x, y, z;
  Axes(const Vec3f& normal, const Vec3f& towards);
  Vec3f toLocal(const Vec3f& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3f toWorld(const Vec3f& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Density proportional to the cosine: cos / pi.
Vec3f cosineDirection(float x, float y);

}  // namespace brisance
