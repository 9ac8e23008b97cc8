#include "view/heat_scale.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {
constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};  // of linear sRGB (IEC 61966-2-1)
}

HeatScale::HeatScale(const BlackbodyColours& heat) {
  float brightest = 0;
  for (int step = 0; step < steps; ++step) {
    const double kelvin = coldest + (hottest - coldest) * step / (steps - 1);
    colours_[step] = step == 0 ? Vec3f{} : heat(static_cast<float>(kelvin));
    brightest_[step] = brightest = std::max(brightest, dot(luminanceWeights, colours_[step]));
  }
}

std::uint8_t HeatScale::ofTemperature(double kelvin) const {
  const double share = std::clamp((kelvin - coldest) / (hottest - coldest), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(share * (steps - 1)));
}

std::uint8_t HeatScale::ofLight(const Vec3f& light) const {
  const auto above = std::upper_bound(brightest_.begin(), brightest_.end(), dot(luminanceWeights, light));
  return static_cast<std::uint8_t>(std::max<std::ptrdiff_t>(above - brightest_.begin() - 1, 0));
}

}  // namespace brisance
