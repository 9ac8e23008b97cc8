#include "assets/sky.h"

#include <cmath>

namespace brisance::assets {
namespace {

Vec3d mixed(const Vec3d& a, const Vec3d& b, double share) { return a * (1 - share) + b * share; }

}  // namespace

Vec3f skyLight(const Vec3d& direction) {
  const Vec3d zenith{0.10, 0.22, 0.50}, horizon{0.85, 0.62, 0.45}, ground{0.08, 0.07, 0.06};
  const Vec3d toSun = normalized(Vec3d(-0.75, 0.35, -0.25));
  const double near = dot(direction, toSun);
  const Vec3d haze = Vec3d(1.0, 0.75, 0.45) * (1.2 * std::exp(12 * (near - 1)) + 60 * std::exp(900 * (near - 1)));
  if (direction.y < 0) return Vec3f(mixed(horizon * 0.5, ground, std::min(1.0, -12 * direction.y)));
  return Vec3f(mixed(horizon, zenith, std::pow(direction.y, 0.45)) + haze);
}

}  // namespace brisance::assets
