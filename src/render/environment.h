// Light from infinitely far away, the same at every place.
#pragma once

#include <optional>
#include <vector>

#include "render/image.h"
#include "render/render_settings.h"

namespace brisance {

/// A direction drawn for its light.
struct EnvironmentSample {
  Vec3f direction;
  Vec3f radiance;
  float density;  ///< [1/sr]
};

/// One colour all around, or a picture of all directions: its middle lies towards -z, its upper edge at +y.
class Environment {
 public:
  Environment(const Vec3f& everywhere) : everywhere_(everywhere) {}  // NOLINT: a colour is one
  Environment(const Image& picture, const EnvironmentSettings& settings);

  Vec3f operator()(const Vec3f& direction) const;
  /// Whether all directions are alike, so that there is nothing to draw for.
  bool isEven() const { return picture_.pixels.empty(); }
  /// Nothing when there is no light, or all directions are alike.
  std::optional<EnvironmentSample> sample(float x, float y) const;
  /// With which density [1/sr] sample() draws a direction.
  float density(const Vec3f& direction) const;

 private:
  struct Place {
    float x, y;  ///< [pixels], from the upper left corner
  };
  Place placeOf(const Vec3f& direction) const;
  Vec3f between(const Place& place) const;

  Vec3f everywhere_;
  Image picture_;
  float rotation_ = 0;              ///< [turns]
  std::vector<float> rowsUpTo_;     ///< light of the rows up to each, each weighed by the solid angle of its pixels
  std::vector<float> columnsUpTo_;  ///< within each row, likewise
  std::vector<float> light_;        ///< of each pixel
};

/// The environment that settings ask for. Throws InputError or DamagedFile for a picture that cannot be had.
Environment environmentOf(const RenderSettings& settings);

}  // namespace brisance
