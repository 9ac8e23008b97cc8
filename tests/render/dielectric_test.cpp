#include "render/dielectric.h"

#include <gtest/gtest.h>

using namespace brisance;

namespace {

constexpr float rounding = 1e-6f;  // about ten roundings of a float
constexpr float glassIndex = 1.5f;

Vec3f incoming(double degrees, double side) {
  const double a = degrees * pi / 180;
  return Vec3f(Vec3d(side * std::sin(a), -std::cos(a), 0));
}
constexpr Vec3f up{0, 1, 0};

}  // namespace

TEST(Reflection, KeepsTheTangentAndTurnsTheNormalPartForBothSignsOfTheNormal) {
  for (const double side : {1.0, -1.0})
    for (const Vec3f& normal : {up, -up}) {
      const Vec3f out = reflected(incoming(30, side), normal);
      EXPECT_NEAR(out.x, side * 0.5, rounding);
      EXPECT_NEAR(out.y, std::sqrt(0.75), rounding);
      EXPECT_EQ(out.z, 0);
    }
}

TEST(Refraction, ObeysSnellsLawIntoAndOutOfGlassMirrored) {
  for (const double side : {1.0, -1.0})
    for (const float ratio : {1 / glassIndex, glassIndex}) {
      const auto out = refracted(incoming(35, side), up, ratio);
      ASSERT_TRUE(out.has_value());
      EXPECT_NEAR(out->x, side * ratio * std::sin(35 * pi / 180), rounding);
      EXPECT_NEAR(length(*out), 1, rounding);
      EXPECT_LT(out->y, 0);  // goes on, away from the normal
    }
}

TEST(Refraction, TotalInternalReflectionBeginsAtTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5) * 180 / pi;
  EXPECT_TRUE(refracted(incoming(critical - 0.1, 1), up, glassIndex).has_value());
  EXPECT_FALSE(refracted(incoming(critical + 0.1, 1), up, glassIndex).has_value());
  EXPECT_EQ(fresnelReflectance(static_cast<float>(std::cos((critical + 0.1) * pi / 180)), glassIndex), 1);
}

TEST(Fresnel, ReturnsFourPercentAtNormalIncidenceFromBothSides) {
  EXPECT_NEAR(fresnelReflectance(1, 1 / glassIndex), 0.04, rounding);
  EXPECT_NEAR(fresnelReflectance(1, glassIndex), 0.04, rounding);
}

TEST(Fresnel, ReturnsAllAtGrazingIncidenceAndNothingWithoutAStepOfTheIndex) {
  EXPECT_NEAR(fresnelReflectance(0, 1 / glassIndex), 1, rounding);
  for (const float cosine : {0.1f, 0.5f, 1.0f}) EXPECT_NEAR(fresnelReflectance(cosine, 1), 0, rounding);
}

// At Brewster's angle, tan = n, only light across the plane of incidence returns: sin^2(theta_i - theta_t), and the two
// angles add up to a right one.
TEST(Fresnel, AtBrewstersAngleOnlyOnePolarisationReturns) {
  const double angle = std::atan(1.5), across = std::sin(2 * angle - pi / 2);
  EXPECT_NEAR(fresnelReflectance(static_cast<float>(std::cos(angle)), 1 / glassIndex), 0.5 * across * across, rounding);
}

// Fresnel's formulas in angles: (sin(a - b) / sin(a + b))^2 and (tan(a - b) / tan(a + b))^2.
TEST(Fresnel, AgreesWithTheFormulasInAnglesAndIsTheSameBackwards) {
  for (double degrees = 5; degrees < 90; degrees += 5) {
    const double a = degrees * pi / 180, b = std::asin(std::sin(a) / 1.5);
    const double s = std::sin(a - b) / std::sin(a + b), p = std::tan(a - b) / std::tan(a + b);
    const double exact = 0.5 * (s * s + p * p);
    EXPECT_NEAR(fresnelReflectance(static_cast<float>(std::cos(a)), 1 / glassIndex), exact, 4 * rounding);
    EXPECT_NEAR(fresnelReflectance(static_cast<float>(std::cos(b)), glassIndex), exact,
                2e-5);  // 1/cos(a) at 85 degrees
  }
}

TEST(Beer, AbsorptionOverTwiceTheWayIsSquared) {
  const Vec3f absorption{1, 2, 0}, once = beerTransmittance(absorption, 0.3f),
                                   twice = beerTransmittance(absorption, 0.6f);
  EXPECT_NEAR(once.x, std::exp(-0.3), rounding);
  EXPECT_EQ(once.z, 1);
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(twice[channel], once[channel] * once[channel], rounding);
}
