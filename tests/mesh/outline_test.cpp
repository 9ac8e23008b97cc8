#include "mesh/outline.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "mesh/flat_samples.h"

namespace brisance {
namespace {

std::string faultOf(std::vector<Vec2d> corners) { return outlineFault(PolygonOutline{std::move(corners)}); }

TEST(Outline, OfASimplePolygonHasNoFault) {
  for (const Outline& outline : sampleOutlines()) EXPECT_EQ(outlineFault(outline), "");
  EXPECT_EQ(faultOf({{0, 0}, {0, 1}, {1, 0}}), "") << "clockwise";
  EXPECT_EQ(faultOf({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}), "") << "a corner in line with its neighbours";
}

TEST(Outline, RefusesWhatEnclosesNoArea) {
  EXPECT_NE(faultOf({}).find("at least 3 corners, got 0"), std::string::npos);
  EXPECT_NE(faultOf({{0, 0}, {1, 1}}).find("got 2"), std::string::npos);
  EXPECT_NE(faultOf({{0, 0}, {1, 0}, {2, 0}, {3, 0}}).find("one line"), std::string::npos);
  EXPECT_NE(faultOf({{1, 1}, {1, 1}, {1, 1}}), "");
  EXPECT_NE(faultOf({{0, 0}, {1, 1}, {2, 2}}), "");
  EXPECT_NE(outlineFault(RectangleOutline{0, 1}), "");
  EXPECT_NE(outlineFault(DiscOutline{-1}), "");
  EXPECT_NE(faultOf({{0, 0}, {std::nan(""), 0}, {0, 1}}), "");
}

TEST(Outline, RefusesEdgesThatCrossOrTouch) {
  EXPECT_NE(faultOf({{0, 0}, {1, 1}, {1, 0}, {0, 1}}).find("1-2 and 3-4"), std::string::npos) << "a bow tie";
  EXPECT_NE(faultOf({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}), "") << "a corner on an edge";
  EXPECT_NE(faultOf({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}), "") << "there and back";
  EXPECT_NE(faultOf({{0, 0}, {1, 0}, {1, 0}, {1, 1}}), "") << "one corner twice";
  EXPECT_NE(faultOf({{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {1, 1}}), "") << "one corner visited twice";
}

TEST(Outline, TurnsCounterClockwise) {
  const std::vector<Vec2d> clockwise{{0, 0}, {0, 2}, {1, 0}};
  EXPECT_EQ(polygonArea(clockwise), -1);
  EXPECT_EQ(polygonArea(outlineCorners(PolygonOutline{clockwise}, 1)), 1);
  for (const Outline& outline : sampleOutlines()) EXPECT_GT(polygonArea(outlineCorners(outline, 0.1)), 0);
}

TEST(Outline, OfADiscFillsTheCircle) {
  // A regular polygon of n corners misses the share (2 pi / n)^2 / 6 of its circle, to leading order.
  for (const double spacing : {1e9, 0.01}) {
    const std::vector<Vec2d> corners = outlineCorners(DiscOutline{0.4}, spacing);
    const double missing = 1 - polygonArea(corners) / (pi * 0.4 * 0.4);
    EXPECT_NEAR(missing, std::pow(2 * pi / static_cast<double>(corners.size()), 2) / 6, 1e-6);
    for (const Vec2d& c : corners) EXPECT_NEAR(std::hypot(c.x, c.y), 0.4, 1e-15);
  }
}

TEST(PolygonInside, HoldsWhatIsInsideAndFarFromTheBorder) {
  const PolygonInside clamp(outlineCorners(clampOutline(), 1), 0.25);
  EXPECT_TRUE(clamp.contains({0.5, 1.5}));
  EXPECT_TRUE(clamp.contains({2.5, 0.5}));
  EXPECT_FALSE(clamp.contains({2, 1.5})) << "between the arms";
  EXPECT_FALSE(clamp.contains({0.9, 1.5})) << "near the border";
  EXPECT_FALSE(clamp.contains({-1, 1.5}));
  EXPECT_FALSE(clamp.contains({1, 5}));
}

TEST(DistanceToBorder, EndsAtTheFirstEdge) {
  const std::vector<Vec2d> clamp = outlineCorners(clampOutline(), 1);
  EXPECT_DOUBLE_EQ(distanceToBorder(clamp, {2, 0.5}, {0, 1}), 0.5);
  EXPECT_DOUBLE_EQ(distanceToBorder(clamp, {2, 0.5}, {-1, 0}), 2);
  EXPECT_DOUBLE_EQ(distanceToBorder(clamp, {0.5, 0.5}, {0, 1}), 2.5);
}

}  // namespace
}  // namespace brisance
