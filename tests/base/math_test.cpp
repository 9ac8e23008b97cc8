#include "base/math.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace brisance {
namespace {

constexpr int samples = 200000;
// The promise is 1e-15 of rounding; the reference is itself rounded to 1.1e-16.
constexpr double relative = 2e-15;

double inRange(int n, double lower, double upper) {
  return lower + (upper - lower) * Random(1, Stream::test).uniform(static_cast<std::uint64_t>(n));
}

TEST(PortableExp, AgreesWithTheLibraryOverItsWholeRange) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(n, -700, 700);
    ASSERT_NEAR(portableExp(x) / std::exp(x), 1, relative) << x;
  }
}

TEST(PortableExp, IsOneAtZeroAndEndsInZeroAndInfinity) {
  EXPECT_EQ(portableExp(0), 1);
  EXPECT_EQ(portableExp(-0.0), 1);
  EXPECT_EQ(portableExp(-1000), 0);
  EXPECT_EQ(portableExp(1000), HUGE_VAL);
}

TEST(PortableLog, AgreesWithTheLibraryOverManyMagnitudes) {
  for (int n = 0; n < samples; ++n) {
    const double x = std::exp(inRange(n, -600, 600));
    // Near x = 1 the logarithm itself is small: there the error counts against the distance from 1 that is
    // representable.
    ASSERT_NEAR(portableLog(x), std::log(x), relative * std::abs(std::log(x))) << x;
  }
}

TEST(PortableLog, AgreesWithTheLibraryNearOne) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(n, 0.5, 2);
    ASSERT_NEAR(portableLog(x), std::log(x), relative * std::abs(std::log(x))) << x;
  }
  EXPECT_EQ(portableLog(1), 0);
}

TEST(PortableLog, UndoesTheExponential) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(n, -700, 700);
    // A relative error of e^x is an absolute one of its logarithm.
    ASSERT_NEAR(portableLog(portableExp(x)), x, relative * (1 + std::abs(x)));
  }
}

TEST(PortableSinCos, AgreesWithTheLibraryForBothSignsOfTheAngle) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(n, -10, 10);
    const auto [s, c] = portableSinCos(x);
    ASSERT_NEAR(s, std::sin(x), relative) << x;
    ASSERT_NEAR(c, std::cos(x), relative) << x;
  }
}

TEST(PortableSinCos, LiesOnTheUnitCircleForLargeAngles) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(n, -1e5, 1e5);
    const auto [s, c] = portableSinCos(x);
    ASSERT_NEAR(s * s + c * c, 1, 2 * relative) << x;
    // pi/2 is subtracted in two parts, k of them: what remains of the angle is known to k times the last part's
    // rounding.
    ASSERT_NEAR(s, std::sin(x), 1e-11) << x;
  }
}

TEST(PortableSinCos, IsOddAndEven) {
  for (int n = 0; n < 1000; ++n) {
    const double x = inRange(n, 0, 100);
    ASSERT_EQ(portableSinCos(-x).sin, -portableSinCos(x).sin);
    ASSERT_EQ(portableSinCos(-x).cos, portableSinCos(x).cos);
  }
}

TEST(PortableAtan2, AgreesWithTheLibraryInAllQuadrantsAndScales) {
  for (int n = 0; n < samples; ++n) {
    const double x = inRange(2 * n, -1, 1) * std::exp2(inRange(n, -60, 60)), y = inRange(2 * n + 1, -1, 1);
    ASSERT_NEAR(portableAtan2(y, x) / std::atan2(y, x), 1, relative) << y << " " << x;
  }
}

TEST(PortableAtan2, KnowsTheAxesAndTheDiagonals) {
  EXPECT_EQ(portableAtan2(0, 0), 0);
  EXPECT_EQ(portableAtan2(0, 1), 0);
  EXPECT_EQ(portableAtan2(1, 0), pi / 2);
  EXPECT_EQ(portableAtan2(0, -1), pi);
  EXPECT_EQ(portableAtan2(-1, 0), -pi / 2);
  EXPECT_EQ(portableAtan2(2, 2), pi / 4);
  EXPECT_EQ(portableAtan2(-2, -2), -3 * pi / 4);
}

TEST(Quaternion, TurnsAsItsMatrixDoesAndBack) {
  const Random random(2, Stream::test);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const Quaternion q = axisAngle(random.onSphere(n), 6 * random.uniform(n) - 3);
    const Vec3d v = random.normal3(n), turned = rotate(q, v);
    EXPECT_NEAR(length(turned), length(v), 1e-14 * length(v));
    EXPECT_NEAR(length(rotate(conjugate(q), turned) - v), 0, 1e-14 * length(v));
    EXPECT_NEAR(determinant(rotationMatrix(q)), 1, 1e-14);
  }
}

TEST(Quaternion, QuarterTurnAboutEachAxisIsRightHanded) {
  EXPECT_NEAR(length(rotate(axisAngle({0, 0, 1}, pi / 2), Vec3d(1, 0, 0)) - Vec3d(0, 1, 0)), 0, 1e-15);
  EXPECT_NEAR(length(rotate(axisAngle({1, 0, 0}, pi / 2), Vec3d(0, 1, 0)) - Vec3d(0, 0, 1)), 0, 1e-15);
  EXPECT_NEAR(length(rotate(axisAngle({0, 1, 0}, pi / 2), Vec3d(0, 0, 1)) - Vec3d(1, 0, 0)), 0, 1e-15);
}

TEST(Quaternion, ProductIsOneTurnAfterTheOther) {
  const Random random(3, Stream::test);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const Quaternion a = axisAngle(random.onSphere(2 * n), 1.5), b = axisAngle(random.onSphere(2 * n + 1), -0.7);
    const Vec3d v = random.onSphere(n + 5000);
    EXPECT_NEAR(length(rotate(a * b, v) - rotate(a, rotate(b, v))), 0, 1e-14);
  }
}

TEST(Mat3, InverseUndoesTheMatrix) {
  const Mat3 m{{{2, -1, 0.5}, {0, 3, 1}, {-1, 0.25, 4}}};
  const Mat3 one = m * inverse(m);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) EXPECT_NEAR(one.row[row][column], row == column, 1e-15);
}

}  // namespace
}  // namespace brisance
