// Surfaces that shine, as lights to draw places from.
#pragma once

#include <optional>
#include <vector>

#include "frame/frame.h"
#include "render/materials.h"

namespace brisance {

struct AreaSample {
  Vec3f place;     ///< [m]
  Vec3f normal;    ///< unit; both sides shine
  Vec3f radiance;  ///< to either side
  float density;   ///< [1/m2]
};

/// The shining triangles of a frame, drawn by their area times the luminance of their material.
class AreaLights {
 public:
  /// `openTime` as for SceneGeometry.
  AreaLights(const std::vector<FrameBody>& bodies, const MaterialTable& materials, double openTime);
  bool isDark() const { return triangles_.empty(); }
  /// `time` 0 .. 1 of the open shutter. Not to be called where it is dark.
  AreaSample sample(float choice, const Vec2<float>& where, float time) const;
  /// With which density [1/m2] sample() draws a place of a surface of a material.
  float density(std::uint16_t material) const {
    return total_ > 0 ? luminances_[material] / static_cast<float>(total_) : 0;
  }

 private:
  struct ShiningTriangle {
    Vec3f corner[3], moved[3];  ///< [m] while the shutter opens, and how far it has moved when it closes
    Vec2<float> uv[3];
    Vec3f inBody[3];
    std::uint16_t material;
  };
  void add(const FrameBody& body, const std::vector<std::uint16_t>& ofTriangles, double openTime);

  const MaterialTable* materials_;
  std::vector<float> luminances_;  ///< by material
  std::vector<ShiningTriangle> triangles_;
  std::vector<double> upTo_;  ///< area times luminance of the triangles up to each
  double total_ = 0;
};

}  // namespace brisance
