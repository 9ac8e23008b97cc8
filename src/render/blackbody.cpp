#include "render/blackbody.h"

#include <cmath>

namespace brisance {
namespace {

constexpr double planckConstant = 6.62607015e-34;                        // [J s]
constexpr double lightSpeed = 299792458;                                 // [m/s]
constexpr double boltzmannConstant = 1.380649e-23;                       // [J/K]
constexpr double lowestWavelength = 380e-9, highestWavelength = 780e-9;  // [m]
constexpr int wavelengthSteps = 80;

constexpr double coldest = 300, hottest = 10000, tableStep = 5;  // [K]
constexpr Vec3d luminanceWeights{0.2126, 0.7152, 0.0722};

/// A Gaussian with one width to the left of its peak and another to the right [nm].
double lobe(double nanometres, double peak, double left, double right) {
  const double t = (nanometres - peak) / (nanometres < peak ? left : right);
  return std::exp(-0.5 * t * t);
}

/// XYZ to linear sRGB (IEC 61966-2-1).
Vec3d srgbFromXyz(const Vec3d& xyz) {
  return Mat3{{{3.2404542, -1.5371385, -0.4985314},
               {-0.9692660, 1.8760108, 0.0415560},
               {0.0556434, -0.2040259, 1.0572252}}} *
         xyz;
}

/// Red, green and blue below zero are brought to zero and the rest scaled so that the luminance stays.
Vec3d intoGamut(const Vec3d& rgb) {
  const Vec3d inside = max(rgb, Vec3d{});
  const double before = dot(luminanceWeights, rgb), after = dot(luminanceWeights, inside);
  return after > 0 ? inside * (before / after) : inside;
}

Vec3f colourOf(const PhysicalBlackbody& map, double temperature) {
  const double exposure = 1 / dot(luminanceWeights, blackbodyLight(map.exposureTemperature));
  return Vec3f(blackbodyLight(temperature) * exposure);
}

/// The thesis adjusts Planck's value P by 2 P^2 + 100 P + 1000 without saying its unit. Here P is the exitance at three
/// wavelengths relative to red at 2000 K; the constant is the thesis' black and therefore subtracted, and the rest
/// divided so that red is 1 at 2000 K.
Vec3f colourOf(const TunedBlackbody&, double temperature) {
  constexpr Vec3d wavelengths{611e-9, 549e-9, 464e-9};  // dominant ones of the primaries of sRGB
  constexpr double referenceTemperature = 2000;
  const double unit = planckExitance(wavelengths.x, referenceTemperature);
  const auto tuned = [&](double wavelength) {
    const double p = planckExitance(wavelength, temperature) / unit;
    return static_cast<float>((2 * p * p + 100 * p) / 102);
  };
  return {tuned(wavelengths.x), tuned(wavelengths.y), tuned(wavelengths.z)};
}

}  // namespace

double planckExitance(double wavelength, double temperature) {
  const double lambda5 = wavelength * wavelength * wavelength * wavelength * wavelength;
  const double exponent = planckConstant * lightSpeed / (wavelength * boltzmannConstant * temperature);
  return 2 * pi * planckConstant * lightSpeed * lightSpeed / (lambda5 * std::expm1(exponent));
}

Vec3d colourMatching(double wavelength) {
  const double nm = wavelength * 1e9;
  return {
      1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
      0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
      1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

Vec3d blackbodyLight(double temperature) {
  constexpr double step = (highestWavelength - lowestWavelength) / wavelengthSteps;
  Vec3d xyz;
  for (int i = 0; i < wavelengthSteps; ++i) {
    const double wavelength = lowestWavelength + (i + 0.5) * step;
    xyz += colourMatching(wavelength) * (planckExitance(wavelength, temperature) * step);
  }
  return intoGamut(srgbFromXyz(xyz));
}

BlackbodyColours::BlackbodyColours(const BlackbodyMap& map) {
  const int entries = static_cast<int>((hottest - coldest) / tableStep) + 1;
  table_.reserve(entries);
  for (int i = 0; i < entries; ++i)
    table_.push_back(std::visit([&](const auto& kind) { return colourOf(kind, coldest + i * tableStep); }, map));
}

Vec3f BlackbodyColours::operator()(float temperature) const {
  const auto steps = (temperature - static_cast<float>(coldest)) / static_cast<float>(tableStep);
  if (!(steps >= 0)) return {};
  if (steps >= static_cast<float>(table_.size() - 1)) return table_.back();
  const auto i = static_cast<std::size_t>(steps);
  const float share = steps - static_cast<float>(i);
  return table_[i] * (1 - share) + table_[i + 1] * share;
}

}  // namespace brisance
