// Solids as functions of space, below 0 inside: simple ones, near their true distance, and smooth unions of them.
#pragma once

#include <functional>
#include <vector>

#include "base/math.h"

namespace brisance::samples {

/// A function of space that is below 0 inside a body and grows outward at a rate of about 1.
using Implicit = std::function<double(const Vec3d&)>;

/// The lesser of two distances, rounded where they are alike within k (Quilez 2008).
double smoothUnion(double a, double b, double k);

Implicit ball(const Vec3d& centre, double radius);

/// A ball of radius `a.radius` rolled to another place while it shrinks or grows: limbs, horns, tails.
struct RoundEnd {
  Vec3d place;
  double radius;
};
Implicit roundCone(const RoundEnd& a, const RoundEnd& b);
/// Round cones from each place to the next.
Implicit limb(const std::vector<RoundEnd>& joints);

/// Half axes along directions at right angles; the third direction is at right angles to both. The distance is that of
/// the first order, exact at the surface (Taubin 1994).
struct EllipsoidFrame {
  Vec3d first{1, 0, 0}, second{0, 1, 0};
};
Implicit ellipsoid(const Vec3d& centre, const Vec3d& radii, const EllipsoidFrame& frame = {});

/// Everything above the plane through `place` that faces along `normal` (of any length) is outside.
Implicit halfSpace(const Vec3d& place, const Vec3d& normal);

/// The solid and its mirror image in the plane where coordinate `axis` is 0. A crease where they meet.
Implicit mirrored(const Implicit& solid, int axis);

/// Solids joined one after another, each with its own width of blending [m] to all before it.
class Union {
 public:
  Union& add(const Implicit& solid, double blend);
  /// Takes the solid away; the rim is rounded.
  Union& carve(const Implicit& solid, double blend);
  double operator()(const Vec3d& p) const;

 private:
  struct Part {
    Implicit solid;
    double blend;
    bool carves;
  };
  std::vector<Part> parts_;
};

/// Direction in which the function grows, by central differences; its length is the rate of growth.
Vec3d gradientOf(const Implicit& solid, const Vec3d& p);
/// The point of the surface that Newton steps along the gradient arrive at from p.
Vec3d ontoSurface(const Implicit& solid, Vec3d p);

}  // namespace brisance::samples
