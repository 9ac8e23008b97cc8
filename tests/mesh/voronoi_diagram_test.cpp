#include "mesh/voronoi_diagram.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "base/random.h"
#include "mesh/flat_samples.h"

namespace brisance {
namespace {

std::vector<Vec2d> sitesIn(const Outline& outline, int count) {
  const PanePoints pane = placePoints(outline, UniformPoints{}, count, 6);
  return {pane.points.begin() + static_cast<std::ptrdiff_t>(cornersFor(outline, count).size()),
          pane.points.begin() + static_cast<std::ptrdiff_t>(cornersFor(outline, count).size()) + count};
}

TEST(VoronoiDiagram, FillsTheOutlineWithItsCells) {
  for (const Outline& outline : sampleOutlines()) {
    const std::vector<Vec2d> corners = cornersFor(outline, 200);
    const VoronoiDiagram diagram = voronoiDiagram(sitesIn(outline, 200), corners);
    double sum = 0;
    for (const auto& cell : diagram.cells) sum += polygonArea(cell);
    EXPECT_NEAR(sum, polygonArea(corners), 1e-11);  // rounding of a few thousand corners of about 1 m
  }
}

TEST(VoronoiDiagram, HasEveryPlaceInTheCellOfTheNearestSite) {
  const std::vector<Vec2d> sites = sitesIn(RectangleOutline{1, 1}, 60);
  const VoronoiDiagram diagram = voronoiDiagram(sites, outlineCorners(RectangleOutline{1, 1}, 1));
  std::vector<PolygonInside> cells;
  for (const auto& cell : diagram.cells) cells.emplace_back(cell, 1e-9);
  const Random random(1, Stream::test);
  int told = 0;
  for (std::uint64_t i = 0; i < 4000; i += 2) {
    const Vec2d p{random.uniform(i) - 0.5, random.uniform(i + 1) - 0.5};
    const auto nearest =
        std::min_element(sites.begin(), sites.end(),
                         [&](const Vec2d& a, const Vec2d& b) { return distanceOf(a, p) < distanceOf(b, p); }) -
        sites.begin();
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      if (cells[cell].contains(p)) {
        EXPECT_EQ(cell, static_cast<std::size_t>(nearest));
        ++told;
      }
  }
  EXPECT_GT(told, 1990) << "of 2000 places few lie within 1e-9 m of an edge";
}

TEST(VoronoiDiagram, HasEdgesAsNearToBothSitesAndNoNearerToAnother) {
  for (const Outline& outline : sampleOutlines()) {
    const VoronoiDiagram diagram = voronoiDiagram(sitesIn(outline, 120), cornersFor(outline, 120));
    EXPECT_GT(diagram.edges.size(), 120u);
    for (const VoronoiEdge& edge : diagram.edges)
      for (const Vec2d& p : {edge.from, edge.to, (edge.from + edge.to) * 0.5}) {
        const double toA = distanceOf(p, diagram.sites[edge.a]);
        EXPECT_NEAR(toA, distanceOf(p, diagram.sites[edge.b]), 1e-9);
        for (const Vec2d& site : diagram.sites) EXPECT_GT(distanceOf(p, site), toA - 1e-9);
      }
  }
}

TEST(VoronoiDiagram, OfFourSitesOnACircleMeetsInOnePoint) {
  const std::vector<Vec2d> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const VoronoiDiagram diagram = voronoiDiagram({{0.5, 0}, {0, 0.5}, {-0.5, 0}, {0, -0.5}}, square);
  ASSERT_EQ(diagram.edges.size(), 4u);
  for (const VoronoiEdge& edge : diagram.edges) {
    EXPECT_NEAR(std::min(std::hypot(edge.from.x, edge.from.y), std::hypot(edge.to.x, edge.to.y)), 0, 1e-15);
    EXPECT_NEAR(distanceOf(edge.from, edge.to), std::sqrt(2), 1e-15);
  }
  for (const auto& cell : diagram.cells) EXPECT_NEAR(polygonArea(cell), 1, 1e-15);
}

TEST(VoronoiDiagram, RefusesSitesOnOneLine) {
  EXPECT_THROW(voronoiDiagram({{0, 0}, {1, 1}, {2, 2}}, {{0, 0}, {2, 0}, {2, 2}}), InputError);
}

}  // namespace
}  // namespace brisance
