// Mirrors and glass (appendix A.1.3, with one sign of the cosine for both as its errors ask).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math.h"

namespace brisance {

/// Mirror direction of a unit `direction` at a unit `normal` of either sign.
inline Vec3f reflected(const Vec3f& direction, const Vec3f& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

/// Snell's law: the direction behind the surface; `normal` faces the ray (dot(direction, normal) < 0), `ratio` is the
/// refractive index before the surface over that behind it. Nothing at total internal reflection.
inline std::optional<Vec3f> refracted(const Vec3f& direction, const Vec3f& normal, float ratio) {
  const float cosine = -dot(direction, normal);
  const float behind2 = 1 - ratio * ratio * (1 - cosine * cosine);
  if (behind2 < 0) return std::nullopt;
  return direction * ratio + normal * (ratio * cosine - std::sqrt(behind2));
}

/// The share of unpolarised light that a smooth dielectric reflects (Fresnel): `cosine` >= 0 of the angle of incidence,
/// `ratio` as in refracted. 1 at total internal reflection.
inline float fresnelReflectance(float cosine, float ratio) {
  const float behind2 = 1 - ratio * ratio * (1 - cosine * cosine);
  if (behind2 <= 0) return 1;
  const float behind = std::sqrt(behind2);
  const float across = (ratio * cosine - behind) / (ratio * cosine + behind);
  const float along = (cosine - ratio * behind) / (cosine + ratio * behind);
  return 0.5f * (across * across + along * along);
}

/// What passes a way of `distance` [m] through an absorbing medium (Beer and Lambert), `absorption` [1/m].
inline Vec3f beerTransmittance(const Vec3f& absorption, float distance) {
  return {std::exp(-absorption.x * distance), std::exp(-absorption.y * distance), std::exp(-absorption.z * distance)};
}

}  // namespace brisance
