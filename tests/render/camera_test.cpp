#include "render/camera.h"

#include <gtest/gtest.h>

using namespace brisance;

namespace {

constexpr double rounding = 1e-12;  // some thousand roundings of a double

void expectNear(const Vec3d& a, const Vec3d& b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

CameraKey keyAt(double time, const Vec3d& position) { return {time, position, {0, 0, 0}, {0, 1, 0}, 40}; }

}  // namespace

TEST(Camera, ThePointLookedAtIsTheCentreOfThePicture) {
  for (const Vec3d& from : {Vec3d(0, 0, 5), Vec3d(3, -2, 1), Vec3d(-4, 1, -7)}) {
    const CameraKey key{0, from, {0.5, 0.25, -1}, {0, 1, 0}, 35};
    const Camera camera(key, 480, 360);
    expectNear(camera.direction(240, 180), normalized(key.lookAt - from), rounding);
  }
}

TEST(Camera, TheFieldOfViewSpansTheHeightAndPixelsAreSquare) {
  const Camera camera({0, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40}, 400, 200);
  const double edge = std::tan(20 * pi / 180);
  expectNear(camera.direction(200, 0), normalized(Vec3d(0, edge, -1)), rounding);  // up is up
  expectNear(camera.direction(200, 200), normalized(Vec3d(0, -edge, -1)), rounding);
  expectNear(camera.direction(400, 100), normalized(Vec3d(2 * edge, 0, -1)), rounding);  // right is right
  expectNear(camera.direction(0, 100), normalized(Vec3d(-2 * edge, 0, -1)), rounding);
}

TEST(Camera, LookingStraightAlongUpStillMakesAPicture) {
  for (const double sign : {1.0, -1.0}) {
    const Camera camera({0, {0, 0, 0}, {0, sign, 0}, {0, 1, 0}, 40}, 100, 100);
    EXPECT_TRUE(isFinite(camera.direction(0, 0)));
    expectNear(camera.direction(50, 50), Vec3d(0, sign, 0), rounding);
  }
}

TEST(CameraKeys, HoldBeforeTheFirstAndAfterTheLast) {
  const CameraSettings settings{{keyAt(1, {1, 0, 0}), keyAt(2, {5, 0, 0})}, 0};
  expectNear(cameraAt(settings, 0).position, {1, 0, 0}, 0);
  expectNear(cameraAt(settings, 9).position, {5, 0, 0}, 0);
}

TEST(CameraKeys, ThePathGoesThroughEveryKeyWithoutAKink) {
  const CameraSettings settings{{keyAt(0, {0, 0, 5}), keyAt(1, {2, 1, 4}), keyAt(1.5, {3, -1, 3}), keyAt(4, {0, 0, 2})},
                                0};
  for (const CameraKey& key : settings.keys) expectNear(cameraAt(settings, key.time).position, key.position, rounding);
  constexpr double step = 1e-6;
  for (const double time : {1.0, 1.5}) {
    const auto at = [&](double t) { return cameraAt(settings, t).position; };
    const Vec3d before = (at(time) - at(time - step)) / step, after = (at(time + step) - at(time)) / step;
    expectNear(before, after, 1e-4);  // second derivatives of some tens [m/s2] times the step
  }
}

TEST(CameraKeys, AStraightRideAtOneSpeedStaysStraightForAnySpacingOfTheKeys) {
  CameraSettings settings;
  for (const double time : {0.0, 0.3, 1.7, 2.0}) {
    CameraKey key = keyAt(time, Vec3d(1, 2, -3) * time);
    key.fovDegrees = 30 + 5 * time;
    settings.keys.push_back(key);
  }
  for (double time = 0; time <= 2; time += 0.125) {
    expectNear(cameraAt(settings, time).position, Vec3d(1, 2, -3) * time, rounding);
    EXPECT_NEAR(cameraAt(settings, time).fovDegrees, 30 + 5 * time, 100 * rounding);
  }
}

TEST(Camera, AllWaysThroughALensMeetInThePlaneOfFocus) {
  CameraKey key;
  key.position = {1, 2, 3};
  key.lookAt = {0, 0, -4};
  key.lensRadius = 0.3;
  key.focusDistance = 2.5;
  const Camera lens(key, 40, 30);
  const Vec3d forward = normalized(key.lookAt - key.position);
  const auto inFocus = [&](const Vec2<float>& where) {
    const CameraWay way = lens.way(31, 4, where);
    return way.origin + way.direction * ((2.5 - dot(way.origin - key.position, forward)) / dot(way.direction, forward));
  };
  const Vec3d middle = key.position + lens.direction(31, 4) * (2.5 / dot(lens.direction(31, 4), forward));
  for (const Vec2<float> where : {Vec2<float>{0, 0}, Vec2<float>{1, 0.2f}, Vec2<float>{0.5f, 0.9f}}) {
    expectNear(inFocus(where), middle, 1e-6);
    EXPECT_LE(length(lens.way(31, 4, where).origin - key.position), 0.3 + 1e-6);
  }
  EXPECT_NEAR(length(lens.way(31, 4, {1, 0.2f}).origin - key.position), 0.3, 1e-6);
}
