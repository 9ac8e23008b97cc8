#include "mesh/pane_points.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "mesh/flat_samples.h"

namespace brisance {
namespace {

/// The points that do not lie on the border.
std::vector<Vec2d> inner(const PanePoints& pane) {
  const std::set<std::uint32_t> border(pane.border.begin(), pane.border.end());
  std::vector<Vec2d> points;
  for (std::uint32_t i = 0; i < pane.points.size(); ++i)
    if (border.count(i) == 0) points.push_back(pane.points[i]);
  return points;
}

TEST(PlacePoints, GivesExactlyAsManyInsideAsAsked) {
  const std::vector<Outline> outlines = sampleOutlines();
  for (std::size_t o = 0; o < outlines.size(); ++o)
    for (const PointPattern& pattern : samplePatterns(o))
      for (const int count : {0, 1, 2, 37, 500}) {
        const PanePoints pane = placePoints(outlines[o], pattern, count, 3);
        const PolygonInside inside(cornersFor(outlines[o], std::max(1, count)), 0);
        EXPECT_EQ(inner(pane).size(), static_cast<std::size_t>(count));
        for (const Vec2d& p : inner(pane)) EXPECT_TRUE(inside.contains(p)) << p.x << " " << p.y;
      }
}

TEST(PlacePoints, PutsTheBorderAlongTheOutline) {
  const std::vector<Outline> outlines = sampleOutlines();
  for (std::size_t o = 0; o < outlines.size(); ++o)
    for (const PointPattern& pattern : samplePatterns(o)) {
      const PanePoints pane = placePoints(outlines[o], pattern, 300, 3);
      std::vector<Vec2d> border;
      for (const std::uint32_t point : pane.border) border.push_back(pane.points[point]);
      const double area = polygonArea(cornersFor(outlines[o], 300));
      EXPECT_NEAR(polygonArea(border), area, 1e-14 * 300 * area);
    }
}

TEST(PlacePoints, AreTheSameForASeedAndOthersForAnother) {
  for (const PointPattern& pattern : samplePatterns(1)) {
    EXPECT_EQ(placePoints(DiscOutline{}, pattern, 60, 1).points, placePoints(DiscOutline{}, pattern, 60, 1).points);
    EXPECT_NE(placePoints(DiscOutline{}, pattern, 60, 1).points, placePoints(DiscOutline{}, pattern, 60, 2).points);
  }
}

TEST(PlacePoints, OfARectangleAlikeAreThoseOfPanePoints) {
  const PanePoints pane = placePoints(RectangleOutline{2, 0.5}, UniformPoints{}, 100, 7);
  // Points 0.1 m apart on average: 50 of them on the 5 m of the border.
  EXPECT_EQ(pane.points, panePoints(2, 0.5, 100, 50, 7));
}

TEST(PlacePoints, RefusesFaults) {
  EXPECT_THROW(placePoints(PolygonOutline{{{0, 0}, {1, 0}}}, UniformPoints{}, 10, 1), InputError);
  ImpactPoints beside;
  beside.impact = {2, 1.5};  // between the arms
  EXPECT_THROW(placePoints(clampOutline(), beside, 10, 1), InputError);
  ImpactPoints coarse;
  coarse.finest = 0.3;  // of a pane of 1 m x 1 m: an arc at 0.3 m would leave no room for a second
  EXPECT_THROW(placePoints(RectangleOutline{}, coarse, 10, 1), InputError);
}

TEST(BlueNoisePoints, KeepTheirDistance) {
  // Random disks of one size fill 0.547 of the plane at most (Feder 1980): diameter 0.83 of the spacing. The thrower
  // stops earlier, and must do better than the 0.5 of the spacing that a sloppy one would.
  const double least = 0.6;
  for (const Outline& outline : sampleOutlines()) {
    const int count = 400;
    const PanePoints pane = placePoints(outline, BlueNoisePoints{}, count, 11);
    const double spacing = std::sqrt(polygonArea(cornersFor(outline, count)) / count);
    const std::vector<Vec2d> points = inner(pane);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(distanceOf(points[i], points[j]), least * spacing);
      for (const std::uint32_t b : pane.border) EXPECT_GT(distanceOf(points[i], pane.points[b]), least * spacing);
    }
  }
}

TEST(ImpactPoints, GrowRarerWithDistance) {
  ImpactPoints blow;
  blow.impact = {0.1, -0.05};
  const std::vector<Vec2d> points = inner(placePoints(DiscOutline{0.5}, blow, 600, 5));
  // Arcs whose radii grow by a constant factor: as many points in each ring of radii r to 2 r, so that the density
  // falls with the square of the distance. Rings must agree within a third, as the innermost and the last arcs are cut.
  std::vector<double> inRing;
  for (double r = 2 * blow.finest; 2 * r < 0.35; r *= 2)
    inRing.push_back(static_cast<double>(std::count_if(points.begin(), points.end(), [&](const Vec2d& p) {
      const double d = distanceOf(p, blow.impact);
      return d >= r && d < 2 * r;
    })));
  ASSERT_GE(inRing.size(), 3u);
  for (const double n : inRing) EXPECT_NEAR(n / inRing[0], 1, 1.0 / 3);
  EXPECT_EQ(points[0], blow.impact);
}

TEST(ImpactPoints, WithoutIrregularityLieOnSpokesAndArcs) {
  ImpactPoints web;
  web.irregularity = 0;
  web.spokes = 8;
  const std::vector<Vec2d> points = inner(placePoints(RectangleOutline{1, 1}, web, 81, 5));
  ASSERT_EQ(points.size(), 81u);
  for (std::size_t i = 1; i < points.size(); ++i) {
    // Eight spokes at odd multiples of pi / 8.
    const double turns = std::atan2(points[i].y, points[i].x) / (pi / 8);
    EXPECT_NEAR(std::abs(std::remainder(turns, 2.0)), 1, 1e-12);
  }
}

}  // namespace
}  // namespace brisance
