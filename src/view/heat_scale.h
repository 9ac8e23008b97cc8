// Heat in one byte: the temperature whose blackbody colour is as bright.
#pragma once

#include <array>
#include <cstdint>

#include "render/blackbody.h"

namespace brisance {

/// Bytes 0 .. 255 stand for temperatures evenly from `coldest` to `hottest`; 0 is dark whatever the map says.
class HeatScale {
 public:
  static constexpr int steps = 256;
  static constexpr double coldest = 500, hottest = 3000;  ///< [K]

  explicit HeatScale(const BlackbodyColours& heat);
  std::uint8_t ofTemperature(double kelvin) const;
  /// Of light, scene-linear: by its luminance.
  std::uint8_t ofLight(const Vec3f& light) const;
  const std::array<Vec3f, steps>& colours() const { return colours_; }

 private:
  std::array<Vec3f, steps> colours_;
  std::array<float, steps> brightest_;  ///< luminance of this step or a colder one: ascending
};

}  // namespace brisance
