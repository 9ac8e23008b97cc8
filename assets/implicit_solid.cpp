#include "assets/implicit_solid.h"

namespace brisance::samples {

double smoothUnion(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

Implicit ball(const Vec3d& centre, double radius) {
  return [=](const Vec3d& p) { return length(p - centre) - radius; };
}

/// In the plane through p and the axis, the side of the cone touches both balls: seen from the axis it leans by the
/// sine (radius difference / distance).
Implicit roundCone(const RoundEnd& a, const RoundEnd& b) {
  const Vec3d axis = b.place - a.place;
  const double distance = length(axis), sine = (a.radius - b.radius) / distance;
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  const Vec3d along = axis / distance;
  return [=](const Vec3d& p) {
    const Vec3d off = p - a.place;
    const double x = dot(off, along), y = length(off - along * x);
    const double foot = x - y * sine / cosine;  // where the side's normal through p meets the axis
    if (foot <= 0) return length(off) - a.radius;
    if (foot >= distance) return length(p - b.place) - b.radius;
    return y * cosine + x * sine - a.radius;
  };
}

Implicit limb(const std::vector<RoundEnd>& joints) {
  std::vector<Implicit> bones;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) bones.push_back(roundCone(joints[i], joints[i + 1]));
  return [bones](const Vec3d& p) {
    double nearest = bones.front()(p);
    for (const Implicit& bone : bones) nearest = std::min(nearest, bone(p));
    return nearest;
  };
}

Implicit ellipsoid(const Vec3d& centre, const Vec3d& radii, const EllipsoidFrame& frame) {
  const Vec3d x = normalized(frame.first), y = normalized(frame.second - x * dot(frame.second, x)), z = cross(x, y);
  return [=](const Vec3d& p) {
    const Vec3d off = p - centre;
    const Vec3d scaled{dot(off, x) / radii.x, dot(off, y) / radii.y, dot(off, z) / radii.z};
    const double k = length(scaled);
    const double slope = length(Vec3d{scaled.x / radii.x, scaled.y / radii.y, scaled.z / radii.z});
    return slope > 0 ? k * (k - 1) / slope : -std::min({radii.x, radii.y, radii.z});
  };
}

Implicit halfSpace(const Vec3d& place, const Vec3d& normal) {
  const Vec3d n = normalized(normal);
  return [=](const Vec3d& p) { return dot(p - place, n); };
}

Implicit mirrored(const Implicit& solid, int axis) {
  return [=](const Vec3d& p) {
    Vec3d image = p;
    image[axis] = -image[axis];
    return std::min(solid(p), solid(image));
  };
}

Union& Union::add(const Implicit& solid, double blend) {
  parts_.push_back({solid, blend, false});
  return *this;
}

Union& Union::carve(const Implicit& solid, double blend) {
  parts_.push_back({solid, blend, true});
  return *this;
}

double Union::operator()(const Vec3d& p) const {
  constexpr double far = 1e3;  // [m] nothing is there yet
  double sum = far;
  for (const auto& [solid, blend, carves] : parts_)
    sum = carves ? -smoothUnion(-sum, solid(p), blend) : smoothUnion(sum, solid(p), blend);
  return sum;
}

Vec3d gradientOf(const Implicit& solid, const Vec3d& p) {
  constexpr double step = 1e-4;  // [m] small beside every rounding, large beside the rounding errors
  Vec3d slope;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d ahead = p, behind = p;
    ahead[axis] += step;
    behind[axis] -= step;
    slope[axis] = (solid(ahead) - solid(behind)) / (2 * step);
  }
  return slope;
}

Vec3d ontoSurface(const Implicit& solid, Vec3d p) {
  constexpr int steps = 8;
  constexpr double closeEnough = 1e-7;  // [m]
  for (int n = 0; n < steps; ++n) {
    const double distance = solid(p);
    if (std::abs(distance) < closeEnough) break;
    const Vec3d slope = gradientOf(solid, p);
    p = p - slope * (distance / std::max(dot(slope, slope), 0.1));
  }
  return p;
}

}  // namespace brisance::samples
