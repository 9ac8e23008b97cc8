// Directions in which fire is seen from a place, drawn by how much light comes from there, so that fire lights the
// walls.
#pragma once

#include <array>
#include <vector>

#include "render/fire_lights.h"

namespace brisance {

/// The fire as a few balls, each as bright as the cluster of glowing gas that it stands for. Only draws depend on them:
/// what light comes along a direction is found by going through the gas itself.
class FireDirections {
 public:
  static constexpr int most = 32;  ///< balls

  explicit FireDirections(const GasMedium& gas);
  bool isDark() const { return balls_.empty(); }

 private:
  friend class FireCones;
  struct Ball {
    Vec3f centre;
    float radius, luminance;  ///< [m], [radiance m2]
  };
  std::vector<Ball> balls_;
};

/// The balls as a place sees them: cones of directions, evenly drawn from within each.
class FireCones {
 public:
  /// `normal` of the surface there, towards the side that is lit, or zero where light is taken from all around. Not to
  /// be called where it is dark.
  FireCones(const FireDirections& fire, const Vec3f& place, const Vec3f& normal);
  /// Whether no ball rises above the surface.
  bool isDark() const { return !(total_ > 0); }
  /// Not to be called where it is dark.
  Vec3f sample(float choice, const Vec2<float>& where) const;
  /// With which density sample() draws a unit direction. [1/sr]
  float density(const Vec3f& direction) const;

 private:
  using PerBall = std::array<float, FireDirections::most>;
  int count_;
  float total_ = 0;
  PerBall x_, y_, z_;  ///< axis of the cone
  PerBall cosine_;     ///< of its half angle; -1: all around
  PerBall versine_;    ///< 1 - cosine, without loss of digits
  PerBall weight_;     ///< of draws, in all `total_`
};

}  // namespace brisance
