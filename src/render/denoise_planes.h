// Channels of a picture laid out for windows that slide over it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "render/image.h"

namespace brisance {

/// One channel with a rim on all sides that repeats its outermost pixels, so that no window need ask where it ends.
class Plane {
 public:
  static constexpr int rim = 16;                         ///< [pixels] at least
  static constexpr int tileWidth = 32, tileHeight = 16;  ///< whole tiles may be read and written

  Plane() = default;
  Plane(int width, int height)
      : width_(width),
        height_(height),
        stride_(roundedUp(width, tileWidth) + 2 * rim),
        values_(static_cast<std::size_t>(stride_) * (roundedUp(height, tileHeight) + 2 * rim)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  float* row(int y) { return values_.data() + stride_ * (y + rim) + rim; }
  const float* row(int y) const { return values_.data() + stride_ * (y + rim) + rim; }

  void fillRim() {
    const int right = static_cast<int>(stride_) - rim;
    for (int y = 0; y < height_; ++y) {
      float* values = row(y);
      std::fill(values - rim, values, values[0]);
      std::fill(values + width_, values + right, values[width_ - 1]);
    }
    const int lower = static_cast<int>(std::ssize(values_) / stride_) - rim;
    for (int y = -rim; y < lower; ++y)
      if (y < 0 || y >= height_) {
        const float* from = row(y < 0 ? 0 : height_ - 1) - rim;
        std::copy(from, from + stride_, row(y) - rim);
      }
  }

 private:
  static int roundedUp(int n, int to) { return (n + to - 1) / to * to; }
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> values_;
};

using ColourPlanes = std::array<Plane, 3>;

/// The mean over (2 radius + 1)^2 pixels around each, of those that are in the picture or its rim.
Plane boxMean(const Plane& plane, int radius);

}  // namespace brisance
