#include "mesh/flat_drawing.h"

#include <gtest/gtest.h>

#include "mesh/flat_samples.h"

namespace brisance {
namespace {

/// Two triangles over the unit square.
FlatMesh square() { return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}}; }

TEST(FlatDrawing, FindsEdgesCutsAndBorder) {
  EXPECT_EQ(edgesOf(square()).size(), 5u);
  EXPECT_EQ(borderOf(square()).size(), 4u);
  EXPECT_TRUE(cutsOf(square(), std::vector<int>{0, 0}).empty());
  const std::vector<Segment> cut = cutsOf(square(), std::vector<int>{0, 1});
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_DOUBLE_EQ(distanceOf(cut[0].from, cut[0].to), std::sqrt(2));
}

TEST(FlatDrawing, DrawsUpwardsInsideItsMargin) {
  FlatDrawing drawing(boundsOf(square().points), 116, 8);
  drawing.polyline(std::vector<Vec2d>{{0, 0}, {1, 1}}, {"#000", 2});
  drawing.text({0.5, 0.5}, "7", 10);
  const std::string svg = drawing.svg();
  EXPECT_NE(svg.find("width=\"116\" height=\"116\""), std::string::npos);
  EXPECT_NE(svg.find("M8.0 108.0L108.0 8.0"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">7</text>"), std::string::npos);
}

TEST(FlatDrawing, GivesNeighboursDifferentColours) {
  FlatDrawing drawing(boundsOf(square().points), 100);
  drawPieces(drawing, square(), std::vector<int>{0, 1}, 2, std::vector<std::string>{"#123", "#456"});
  EXPECT_NE(drawing.svg().find("#123"), std::string::npos);
  EXPECT_NE(drawing.svg().find("#456"), std::string::npos);
}

}  // namespace
}  // namespace brisance
