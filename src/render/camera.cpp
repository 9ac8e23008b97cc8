#include "render/camera.h"

#include <algorithm>
#include <cmath>

namespace brisance {
namespace {

/// The keys around a time: `before` and `after` hold it, `first` and `last` shape the tangents there.
struct Span {
  const CameraKey &first, &before, &after, &last;
  double share;  ///< of the way from before to after
};

/// Cubic Hermite with tangents by central differences in time (Catmull & Rom 1974 for even spacing).
template <class T, class Field>
T between(const Span& span, Field field) {
  const double duration = span.after.time - span.before.time;
  const auto tangent = [&](const CameraKey& a, const CameraKey& b) {
    return (field(b) - field(a)) * (duration / (b.time - a.time));
  };
  const double s = span.share, s2 = s * s, s3 = s2 * s;
  return field(span.before) * (2 * s3 - 3 * s2 + 1) + tangent(span.first, span.after) * (s3 - 2 * s2 + s) +
         field(span.after) * (3 * s2 - 2 * s3) + tangent(span.before, span.last) * (s3 - s2);
}

}  // namespace

CameraKey cameraAt(const CameraSettings& settings, double time) {
  const auto& keys = settings.keys;
  if (keys.empty()) return {};
  if (time <= keys.front().time) return keys.front();
  if (time >= keys.back().time) return keys.back();
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), time, [](double t, const CameraKey& key) { return t < key.time; });
  const auto before = after - 1;
  const Span span{before == keys.begin() ? *before : *(before - 1), *before, *after,
                  after + 1 == keys.end() ? *after : *(after + 1),
                  (time - before->time) / (after->time - before->time)};
  return {time,
          between<Vec3d>(span, [](const CameraKey& k) { return k.position; }),
          between<Vec3d>(span, [](const CameraKey& k) { return k.lookAt; }),
          between<Vec3d>(span, [](const CameraKey& k) { return k.up; }),
          between<double>(span, [](const CameraKey& k) { return k.fovDegrees; }),
          std::max(0.0, between<double>(span, [](const CameraKey& k) { return k.lensRadius; })),
          between<double>(span, [](const CameraKey& k) { return k.focusDistance; })};
}

Camera::Camera(const CameraKey& key, int width, int height)
    : position_(key.position), forward_(normalized(key.lookAt - key.position)), focusDistance_(key.focusDistance) {
  const Vec3d& forward = forward_;
  Vec3d right = cross(forward, key.up);
  constexpr double nearlyAlong = 1e-9;
  if (length(right) <= nearlyAlong * length(key.up))
    right = cross(forward, std::abs(forward.z) < 0.5 ? Vec3d(0, 0, 1) : Vec3d(0, 1, 0));
  right = normalized(right);
  const Vec3d up = cross(right, forward);
  const double pixel = 2 * std::tan(key.fovDegrees * pi / 360) / height;  // at distance 1
  right_ = right * pixel;
  down_ = up * -pixel;
  lensRight_ = right * key.lensRadius;
  lensUp_ = up * key.lensRadius;
  upperLeft_ = forward - right_ * (0.5 * width) - down_ * (0.5 * height);
}

Vec3d Camera::direction(double x, double y) const { return normalized(upperLeft_ + right_ * x + down_ * y); }

Vec2d Camera::pixel(const Vec3d& place) const {
  const Vec3d way = place - position_;
  const Vec3d fromCorner = way / dot(way, forward_) - upperLeft_;
  return {dot(fromCorner, right_) / dot(right_, right_), dot(fromCorner, down_) / dot(down_, down_)};
}

CameraWay Camera::way(double x, double y, const Vec2<float>& lens) const {
  const Vec3d ahead = upperLeft_ + right_ * x + down_ * y;  // 1 along the view
  if (lensRight_ == Vec3d{}) return {position_, normalized(ahead)};
  const double radius = std::sqrt(static_cast<double>(lens.x)), around = 2 * pi * lens.y;
  const Vec3d aside = lensRight_ * (radius * std::cos(around)) + lensUp_ * (radius * std::sin(around));
  return {position_ + aside, normalized(ahead - aside / focusDistance_)};
}

}  // namespace brisance
