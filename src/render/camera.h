// Where pictures are taken from.
#pragma once

#include "render/render_settings.h"

namespace brisance {

/// The camera's place at a time [s] of film: Catmull-Rom through the keys for any spacing of their times; before the
/// first and after the last key that key holds. Keys in order of time; without keys the default key.
CameraKey cameraAt(const CameraSettings& settings, double time);

/// A way that light takes into the camera, backwards.
struct CameraWay {
  Vec3d origin, direction;  ///< [m], unit
};

/// A pinhole or a thin lens.
class Camera {
 public:
  /// A picture of `width` x `height` square pixels. Where `up` is along the view, another axis stands in for it.
  Camera(const CameraKey& key, int width, int height);
  const Vec3d& position() const { return position_; }
  /// Unit, to the middle of the picture.
  const Vec3d& forward() const { return forward_; }
  /// Where the picture has a place that lies before the camera; the inverse of direction().
  Vec2d pixel(const Vec3d& place) const;
  /// Unit direction through a place of the picture: (0, 0) its upper left corner, (width, height) its lower right one.
  Vec3d direction(double x, double y) const;
  /// The way through that place and a place of the lens, both of `lens` uniform in 0 .. 1: all ways of a picture place
  /// meet in the plane of focus.
  CameraWay way(double x, double y, const Vec2<float>& lens) const;

 private:
  Vec3d position_, forward_;
  Vec3d upperLeft_, right_, down_;  ///< upperLeft_ + x right_ + y down_: through pixel place (x, y)
  Vec3d lensRight_, lensUp_;        ///< [m] radii of the lens
  double focusDistance_;            ///< [m]
};

}  // namespace brisance
