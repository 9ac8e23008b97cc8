// Smooth and rough glass.
#include <algorithm>
#include <cmath>

#include "render/dielectric.h"
#include "render/scattering.h"

namespace brisance {
namespace {

constexpr auto onePi = static_cast<float>(pi);
constexpr Vec3f white(1, 1, 1), upward(0, 0, 1);

std::optional<ScatterSample> oneDirection(const Vec3f& in) { return ScatterSample{in, white, 0, true}; }

/// Below: alpha is the slope of GGX, m a microscopic normal with m.z > 0.

/// Walter et al. 2007, eq. 33.
float distribution(float alpha, const Vec3f& m) {
  const float cos2 = m.z * m.z, t = cos2 * (alpha * alpha - 1) + 1;
  return alpha * alpha / (onePi * t * t);
}

/// Smith's share of microscopic surface that is not shadowed from `v`, eq. 34.
float unshadowed(float alpha, const Vec3f& v) {
  const float cos2 = v.z * v.z;
  return 2 / (1 + std::sqrt(1 + alpha * alpha * (1 - cos2) / cos2));
}

/// Density [1/sr] of the normals that drawnNormal() draws: of those seen from `out`.
float normalDensity(float alpha, const Vec3f& out, const Vec3f& m) {
  return unshadowed(alpha, out) * std::max(0.0f, dot(out, m)) * distribution(alpha, m) / out.z;
}

/// Heitz 2018, "Sampling the GGX distribution of visible normals", listing 1.
Vec3f drawnNormal(float alpha, const Vec3f& out, float x, float y) {
  const Vec3f stretched = normalized(Vec3f(alpha * out.x, alpha * out.y, out.z));
  const Axes axes(stretched, cross(upward, stretched));
  const float radius = std::sqrt(x), around = 2 * onePi * y, lift = 0.5f * (1 + stretched.z);
  const float t1 = radius * std::cos(around);
  const float t2 = (1 - lift) * std::sqrt(1 - t1 * t1) + lift * radius * std::sin(around);
  const Vec3f hemisphere = axes.toWorld({t1, t2, std::sqrt(std::max(0.0f, 1 - t1 * t1 - t2 * t2))});
  return normalized(Vec3f(alpha * hemisphere.x, alpha * hemisphere.y, std::max(1e-6f, hemisphere.z)));
}

/// How light between `out` and `in` meets the surface.
struct Meeting {
  Vec3f m;
  float share;     ///< of light that takes this side: Fresnel's reflectance, or the rest
  float jacobian;  ///< solid angle of m per solid angle of `in` (eq. 14 and 17)
};

std::optional<Meeting> meetingOf(const RoughDielectric& surface, const Vec3f& out, const Vec3f& in) {
  if (out.z <= 0 || in.z == 0) return std::nullopt;
  const bool reflects = in.z > 0;
  Vec3f m = normalized(reflects ? out + in : -(out * surface.ratio + in));
  if (m.z < 0) m = -m;
  const float outward = dot(out, m), inward = dot(in, m);
  if (outward <= 0 || (inward > 0) != reflects) return std::nullopt;
  const float mirrorShare = fresnelReflectance(std::min(outward, 1.0f), surface.ratio);
  if (reflects) return Meeting{m, mirrorShare, 1 / (4 * outward)};
  const float base = surface.ratio * outward + inward;
  return Meeting{m, 1 - mirrorShare, -inward / (base * base)};
}

}  // namespace

Vec3f value(const SmoothDielectric&, const Vec3f&, const Vec3f&) { return {}; }
float density(const SmoothDielectric&, const Vec3f&, const Vec3f&) { return 0; }
std::optional<ScatterSample> sample(const SmoothDielectric& surface, const Vec3f& out, const ScatterDraw& draw) {
  if (draw.choice < fresnelReflectance(out.z, surface.ratio)) return oneDirection(reflected(-out, upward));
  const std::optional<Vec3f> through = refracted(-out, upward, surface.ratio);
  return oneDirection(through ? *through : reflected(-out, upward));
}

Vec3f value(const RoughDielectric& surface, const Vec3f& out, const Vec3f& in) {
  const std::optional<Meeting> met = meetingOf(surface, out, in);
  if (!met) return {};
  const float both = unshadowed(surface.alpha, out) * unshadowed(surface.alpha, in);
  return white * (met->share * both * distribution(surface.alpha, met->m) * dot(out, met->m) / out.z * met->jacobian);
}
float density(const RoughDielectric& surface, const Vec3f& out, const Vec3f& in) {
  const std::optional<Meeting> met = meetingOf(surface, out, in);
  return met ? met->share * normalDensity(surface.alpha, out, met->m) * met->jacobian : 0;
}
std::optional<ScatterSample> sample(const RoughDielectric& surface, const Vec3f& out, const ScatterDraw& draw) {
  if (out.z <= 0) return std::nullopt;
  const Vec3f m = drawnNormal(surface.alpha, out, draw.x, draw.y);
  const float outward = dot(out, m);
  if (outward <= 0) return std::nullopt;
  const bool reflects = draw.choice < fresnelReflectance(std::min(outward, 1.0f), surface.ratio);
  const std::optional<Vec3f> through = reflects ? std::nullopt : refracted(-out, m, surface.ratio);
  const Vec3f in = through ? *through : reflected(-out, m);
  if (in.z == 0 || (in.z > 0) == through.has_value()) return std::nullopt;  // it would meet the surface again
  const float p = density(surface, out, in);
  if (!(p > 0)) return std::nullopt;
  return ScatterSample{in, white * unshadowed(surface.alpha, in), p, false};
}

}  // namespace brisance
