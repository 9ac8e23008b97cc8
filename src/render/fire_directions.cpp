#include "render/fire_directions.h"

#include <algorithm>
#include <cmath>

#include "render/scattering.h"

namespace brisance {
namespace {

constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};
constexpr auto twoPi = static_cast<float>(2 * pi);
/// A cube's farthest corner lies so many times farther from its middle than its points do in the root mean square.
constexpr float cornerPerRadius = 1.7320508f;

}  // namespace

FireDirections::FireDirections(const GasMedium& gas) {
  for (const FirePoint& point : findFirePoints(gas, most))
    balls_.push_back({point.position, cornerPerRadius * point.radius, dot(luminanceWeights, point.intensity)});
}

FireCones::FireCones(const FireDirections& fire, const Vec3f& place, const Vec3f& normal)
    : count_(static_cast<int>(fire.balls_.size())) {
  const bool oneSide = normal != Vec3f{};
  for (int n = 0; n < count_; ++n) {
    const FireDirections::Ball& ball = fire.balls_[n];
    const Vec3f way = ball.centre - place;
    const float distance2 = dot(way, way), radius2 = ball.radius * ball.radius;
    const bool outside = distance2 > radius2;
    const float sine2 = outside ? radius2 / distance2 : 1;
    const Vec3f axis = distance2 > 0 ? way / std::sqrt(distance2) : Vec3f(0, 0, 1);
    cosine_[n] = outside ? std::sqrt(1 - sine2) : -1;
    versine_[n] = outside ? sine2 / (1 + cosine_[n]) : 2;
    x_[n] = axis.x, y_[n] = axis.y, z_[n] = axis.z;
    // How much of the ball rises above the surface, and how high.
    const float sine = std::sqrt(sine2), height = std::max((dot(axis, normal) + sine) / (1 + sine), 0.0f);
    weight_[n] = ball.luminance / std::max(distance2, radius2) * (oneSide && outside ? height : 1);
    total_ += weight_[n];
  }
}

Vec3f FireCones::sample(float choice, const Vec2<float>& where) const {
  int n = 0;
  for (float wanted = choice * total_; n + 1 < count_ && wanted >= weight_[n]; ++n) wanted -= weight_[n];
  const float along = 1 - where.x * versine_[n], across = std::sqrt(std::max(1 - along * along, 0.0f));
  const float around = twoPi * where.y;
  return Axes({x_[n], y_[n], z_[n]}, {}).toWorld({across * std::cos(around), across * std::sin(around), along});
}

float FireCones::density(const Vec3f& direction) const {
  constexpr float rounding = 1e-6f;  // of directions drawn at the edge of a cone
  float sum = 0;
  for (int n = 0; n < count_; ++n) {
    const float cosine = x_[n] * direction.x + y_[n] * direction.y + z_[n] * direction.z;
    sum += cosine >= cosine_[n] - rounding ? weight_[n] / versine_[n] : 0;
  }
  return total_ > 0 ? sum / (twoPi * total_) : 0;
}

}  // namespace brisance
