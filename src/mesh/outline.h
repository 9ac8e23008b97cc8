// The border of a flat pane: a rectangle, a disc, or any simple polygon.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Centred on the origin.
struct RectangleOutline {
  double width = 1, height = 1;  ///< [m]
  friend bool operator==(const RectangleOutline&, const RectangleOutline&) = default;
};
/// About the origin.
struct DiscOutline {
  double radius = 0.5;  ///< [m]
  friend bool operator==(const DiscOutline&, const DiscOutline&) = default;
};
/// May be concave; no edge touches another but at their common corner.
struct PolygonOutline {
  std::vector<Vec2d> corners;  ///< [m] either way round
  friend bool operator==(const PolygonOutline&, const PolygonOutline&) = default;
};
using Outline = std::variant<RectangleOutline, DiscOutline, PolygonOutline>;

/// What is wrong with an outline and what would be right, in one line; empty where nothing is.
std::string outlineFault(const Outline& outline);

/// The outline's corners, counter-clockwise. A disc is a regular polygon in the circle, of at least 96 corners and
/// sides of about `spacing` [m] where that asks for more.
std::vector<Vec2d> outlineCorners(const Outline& outline, double spacing);

double polygonArea(const std::vector<Vec2d>& corners);  ///< [m2] above 0 if counter-clockwise
Box3 polygonBounds(const std::vector<Vec2d>& corners);
/// Distance along a ray from a point inside to the first edge of the polygon [m].
double distanceToBorder(const std::vector<Vec2d>& corners, const Vec2d& from, const Vec2d& direction);

/// Asked for many points: the edges lie in horizontal strips.
class PolygonInside {
 public:
  /// Points nearer to the border than `margin` [m] count as outside.
  PolygonInside(std::vector<Vec2d> corners, double margin);
  bool contains(const Vec2d& p) const;

 private:
  std::size_t stripOf(double y) const;

  std::vector<Vec2d> corners_;
  double margin_, lower_, height_;
  std::vector<std::vector<std::uint32_t>> strips_;  ///< edges (by their first corner) that touch each strip
};

}  // namespace brisance
