#include "render/scattering.h"

#include <algorithm>
#include <cmath>

namespace brisance {
namespace {

constexpr auto onePi = static_cast<float>(pi);

float largest(const Vec3f& v) { return std::max({v.x, v.y, v.z}); }

/// Direction of a cosine to the z axis and an angle around it.
Vec3f direction(float cosine, float around) {
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  return {sine * std::cos(around), sine * std::sin(around), cosine};
}

Vec3f mirrored(const Vec3f& v) { return {-v.x, -v.y, v.z}; }

template <class Surface>
std::optional<ScatterSample> sampleOf(const Surface& surface, const Vec3f& out, const Vec3f& in) {
  const float p = density(surface, out, in);
  if (!(p > 0)) return std::nullopt;
  return ScatterSample{in, value(surface, out, in) / p, p, false};
}

}  // namespace

Axes::Axes(const Vec3f& normal, const Vec3f& towards) : z(normal) {
  Vec3f along = towards - normal * dot(normal, towards);
  constexpr float nearlyAlong = 1e-4f;
  if (length(along) <= nearlyAlong * length(towards)) {
    const Vec3f axis = std::abs(normal.x) < 0.6f ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0);
    along = axis - normal * dot(normal, axis);
  }
  x = normalized(along);
  y = cross(z, x);
}

Vec3f cosineDirection(float x, float y) { return direction(std::sqrt(1 - x), 2 * onePi * y); }

Vec3f value(const Lambert& surface, const Vec3f&, const Vec3f& in) {
  return in.z > 0 ? surface.colour * (in.z / onePi) : Vec3f{};
}
float density(const Lambert&, const Vec3f&, const Vec3f& in) { return std::max(0.0f, in.z / onePi); }
std::optional<ScatterSample> sample(const Lambert& surface, const Vec3f&, const ScatterDraw& draw) {
  const Vec3f in = cosineDirection(draw.x, draw.y);
  if (!(in.z > 0)) return std::nullopt;
  return ScatterSample{in, surface.colour, in.z / onePi, false};
}

namespace {

/// The share of samples for the diffuse part, by how much light each returns.
float diffuseShare(const Phong& surface) {
  const float diffuse = largest(surface.diffuse), lobe = largest(surface.specular) * 2 / (surface.exponent + 1);
  return diffuse + lobe > 0 ? diffuse / (diffuse + lobe) : 1;
}

}  // namespace

Vec3f value(const Phong& surface, const Vec3f& out, const Vec3f& in) {
  if (in.z <= 0) return {};
  const float facing = std::max(0.0f, dot(mirrored(out), in));
  return (surface.diffuse * in.z + surface.specular * std::pow(facing, surface.exponent)) / onePi;
}
float density(const Phong& surface, const Vec3f& out, const Vec3f& in) {
  if (in.z <= 0) return 0;
  const float facing = std::max(0.0f, dot(mirrored(out), in)), share = diffuseShare(surface);
  return share * in.z / onePi + (1 - share) * (surface.exponent + 1) / (2 * onePi) * std::pow(facing, surface.exponent);
}
std::optional<ScatterSample> sample(const Phong& surface, const Vec3f& out, const ScatterDraw& draw) {
  if (draw.choice < diffuseShare(surface)) return sampleOf(surface, out, cosineDirection(draw.x, draw.y));
  const Vec3f lobe = direction(std::pow(1 - draw.x, 1 / (surface.exponent + 1)), 2 * onePi * draw.y);
  return sampleOf(surface, out, Axes(mirrored(out), {}).toWorld(lobe));
}

namespace {

/// Schlick's approximation of Fresnel's reflectance, as both use it.
Vec3f schlick(const Vec3f& specular, float cosine) {
  const float rest = 1 - cosine, rest2 = rest * rest;
  return specular + (Vec3f(1, 1, 1) - specular) * (rest2 * rest2 * rest);
}

float fifthPower(float x) { return x * x * x * x * x; }

/// Density of half vectors [1/sr], equation 6 of the paper; the exponent is 0/0 along the normal, where cos is 1.
float halfDensity(const AshikhminShirley& surface, const Vec3f& half) {
  const float across2 = 1 - half.z * half.z;
  const float exponent =
      across2 > 0 ? (surface.exponentU * half.x * half.x + surface.exponentV * half.y * half.y) / across2 : 0;
  return std::sqrt((surface.exponentU + 1) * (surface.exponentV + 1)) / (2 * onePi) * std::pow(half.z, exponent);
}

float diffuseShare(const AshikhminShirley& surface, const Vec3f& out) {
  const float diffuse = largest(surface.diffuse) * (1 - largest(surface.specular));
  const float specular = largest(schlick(surface.specular, out.z));
  return diffuse > 0 ? diffuse / (diffuse + specular) : 0;
}

/// Equations 9 and 10 of the paper, with the quadrants told apart by atan2.
Vec3f drawnHalf(const AshikhminShirley& surface, float x, float y) {
  const float angle = 2 * onePi * x;
  const float around = std::atan2(std::sqrt(surface.exponentU + 1) * std::sin(angle),
                                  std::sqrt(surface.exponentV + 1) * std::cos(angle));
  const float c = std::cos(around), s = std::sin(around);
  const float exponent = surface.exponentU * c * c + surface.exponentV * s * s;
  return direction(std::pow(1 - y, 1 / (exponent + 1)), around);
}

}  // namespace

/// Its terms with the errors of the thesis' print corrected: (h . k) below the specular term, not (n . k).
Vec3f value(const AshikhminShirley& surface, const Vec3f& out, const Vec3f& in) {
  if (in.z <= 0 || out.z <= 0) return {};
  const Vec3f half = normalized(out + in), white(1, 1, 1);
  const float across = dot(half, in);
  const Vec3f diffuse = surface.diffuse * (white - surface.specular) *
                        (28 / (23 * onePi) * (1 - fifthPower(1 - in.z / 2)) * (1 - fifthPower(1 - out.z / 2)));
  const Vec3f specular =
      schlick(surface.specular, across) * (halfDensity(surface, half) / (4 * across * std::max(in.z, out.z)));
  return (diffuse + specular) * in.z;
}
float density(const AshikhminShirley& surface, const Vec3f& out, const Vec3f& in) {
  if (in.z <= 0 || out.z <= 0) return 0;
  const Vec3f half = normalized(out + in);
  const float share = diffuseShare(surface, out);
  return share * in.z / onePi + (1 - share) * halfDensity(surface, half) / (4 * dot(half, out));
}
std::optional<ScatterSample> sample(const AshikhminShirley& surface, const Vec3f& out, const ScatterDraw& draw) {
  if (draw.choice < diffuseShare(surface, out)) return sampleOf(surface, out, cosineDirection(draw.x, draw.y));
  const Vec3f half = drawnHalf(surface, draw.x, draw.y);
  const float across = dot(half, out);
  if (across <= 0) return std::nullopt;
  return sampleOf(surface, out, half * (2 * across) - out);
}

Vec3f value(const SurfaceScattering& surface, const Vec3f& out, const Vec3f& in) {
  return std::visit([&](const auto& kind) { return value(kind, out, in); }, surface);
}
float density(const SurfaceScattering& surface, const Vec3f& out, const Vec3f& in) {
  return std::visit([&](const auto& kind) { return density(kind, out, in); }, surface);
}
std::optional<ScatterSample> sample(const SurfaceScattering& surface, const Vec3f& out, const ScatterDraw& draw) {
  return std::visit([&](const auto& kind) { return sample(kind, out, draw); }, surface);
}

float phaseFunction(float g, float cosine) {
  const float base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * onePi * base * std::sqrt(base));
}

Vec3f samplePhase(float g, const Vec3f& onward, float x, float y) {
  constexpr float nearlyEven = 1e-3f;
  const float term = (1 - g * g) / (1 - g + 2 * g * x);
  const float cosine = std::abs(g) < nearlyEven ? 1 - 2 * x : (1 + g * g - term * term) / (2 * g);
  return Axes(onward, {}).toWorld(direction(std::clamp(cosine, -1.0f, 1.0f), 2 * onePi * y));
}

}  // namespace brisance
