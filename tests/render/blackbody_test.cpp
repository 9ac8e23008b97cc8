#include "render/blackbody.h"

#include <gtest/gtest.h>

using namespace brisance;

namespace {

double luminance(const Vec3f& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

}  // namespace

TEST(Planck, PeaksWhereWienSays) {
  for (const double temperature : {1000.0, 2000.0, 5772.0}) {
    const double expected = 2.897771955e-3 / temperature;
    double peak = 0, most = 0;
    for (double wavelength = 0.5 * expected; wavelength < 2 * expected; wavelength += 1e-4 * expected)
      if (const double here = planckExitance(wavelength, temperature); here > most) most = here, peak = wavelength;
    EXPECT_NEAR(peak / expected, 1, 1e-4);  // the scan's step
  }
}

TEST(Planck, AllWavelengthsTogetherGiveStefanBoltzmann) {
  const double temperature = 2000, step = 10e-9;  // [K], [m]
  double sum = 0;
  for (double wavelength = step; wavelength < 400e-6; wavelength += step)
    sum += planckExitance(wavelength, temperature) * step;
  const double expected = 5.670374419e-8 * std::pow(temperature, 4);
  EXPECT_NEAR(sum / expected, 1, 1e-5);  // the tail beyond 400 um holds 5e-6 of it: 15/pi^4 x^3/3 at x = 0.018 is 3e-7
}

// CIE standard illuminant A is Planck's law at 2856 K: x = 0.44757, y = 0.40745.
TEST(Blackbody, HasTheChromaticityOfIlluminantA) {
  Vec3d xyz;
  for (double wavelength = 380e-9; wavelength < 780e-9; wavelength += 1e-9)
    xyz += colourMatching(wavelength) * planckExitance(wavelength, 2856);
  const double sum = xyz.x + xyz.y + xyz.z;
  EXPECT_NEAR(xyz.x / sum, 0.44757, 0.004);  // the published fit's own error is about a percent of its curves
  EXPECT_NEAR(xyz.y / sum, 0.40745, 0.004);
}

TEST(Blackbody, LuminanceIsOneAtTheExposureTemperature) {
  for (const double temperature : {1500.0, 2000.0, 3000.0}) {
    const BlackbodyColours colours(PhysicalBlackbody{temperature});
    EXPECT_NEAR(luminance(colours(static_cast<float>(temperature))), 1, 1e-5);
  }
}

TEST(Blackbody, GoesFromRedThroughOrangeToYellowWhite) {
  const BlackbodyColours colours(PhysicalBlackbody{2000});
  double green = -1, blue = -1, light = 0;
  for (float temperature = 800; temperature <= 6000; temperature += 100) {
    const Vec3f c = colours(temperature);
    EXPECT_GT(luminance(c), light) << "hotter is brighter";
    EXPECT_GE(c.y / c.x, green) << "the share of green grows with the temperature";
    EXPECT_GE(c.z / c.x, blue) << "and that of blue";
    light = luminance(c), green = c.y / c.x, blue = c.z / c.x;
  }
  const auto share = [&](float temperature) { return colours(temperature).y / colours(temperature).x; };
  EXPECT_LT(share(1000), 0.15);  // red
  EXPECT_GT(share(2200), 0.2);   // orange
  EXPECT_LT(share(2200), 0.5);
  EXPECT_GT(share(4000), 0.6);  // yellow-white
}

TEST(Blackbody, StaysFiniteAndPositiveForAnyTemperature) {
  for (const BlackbodyMap& map : {BlackbodyMap(PhysicalBlackbody{}), BlackbodyMap(TunedBlackbody{})}) {
    const BlackbodyColours colours(map);
    for (const float temperature : {-5.f, 0.f, 299.f, 300.f, 1234.5f, 9999.f, 10000.f, 1e9f, INFINITY}) {
      const Vec3f c = colours(temperature);
      EXPECT_TRUE(isFinite(c)) << temperature;
      EXPECT_GE(std::min({c.x, c.y, c.z}), 0) << temperature;
    }
    EXPECT_EQ(colours(0), Vec3f{});
    EXPECT_EQ(colours(NAN), Vec3f{});
  }
}

TEST(TunedBlackbody, RedIsOneAt2000KelvinAndColdGasGivesNoLight) {
  const BlackbodyColours colours(TunedBlackbody{});
  EXPECT_NEAR(colours(2000).x, 1, 1e-6);
  EXPECT_LT(colours(600).x, 1e-5);
  EXPECT_LT(colours(1500).y / colours(1500).x, colours(3000).y / colours(3000).x);
}
