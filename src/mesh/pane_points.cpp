#include "mesh/pane_points.h"

#include <fmt/format.h>

#include <limits>

#include "base/check.h"
#include "mesh/point_patterns.h"

namespace brisance {
namespace {

/// Point at a distance along the border of a rectangle about the origin, from its lower left corner, counter-clockwise.
Vec2d borderPoint(double width, double height, double distance) {
  const double x = width / 2, y = height / 2;
  if (distance < width) return {distance - x, -y};
  if (distance < width + height) return {x, distance - width - y};
  if (distance < 2 * width + height) return {x - (distance - width - height), y};
  return {-x, y - (distance - 2 * width - height)};
}

/// As many border points as keep the distance that the points inside have on average.
int borderPointsOf(const RectangleOutline& r, int count) {
  if (count < 1) return 0;
  return static_cast<int>(std::lround(2 * (r.width + r.height) / std::sqrt(r.width * r.height / count)));
}

/// The random border points of a rectangle come in order around it, so each side's lie between its corners.
PanePoints rectanglePoints(const RectangleOutline& r, int count, std::uint64_t seed) {
  const int borderCount = borderPointsOf(r, count);
  PanePoints pane{panePoints(r.width, r.height, count, borderCount, seed), {}};
  const double x = r.width / 2, y = r.height / 2;
  const auto sideOf = [&](const Vec2d& p) { return p.y == -y ? 0u : p.x == x ? 1u : p.y == y ? 2u : 3u; };
  auto next = static_cast<std::uint32_t>(4 + count);
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    pane.border.push_back(corner);
    while (next < pane.points.size() && sideOf(pane.points[next]) == corner) pane.border.push_back(next++);
  }
  return pane;
}

PaneArea areaOf(const Outline& outline, int count) {
  constexpr double any = std::numeric_limits<double>::infinity();
  PaneArea pane{outlineCorners(outline, any), std::holds_alternative<DiscOutline>(outline), count, any};
  if (count < 1) return pane;
  pane.spacing = std::sqrt(polygonArea(pane.corners) / count);
  pane.corners = outlineCorners(outline, pane.spacing);
  return pane;
}

template <class Pattern>
PanePoints patternPoints(const PaneArea& area, const Pattern& pattern, std::uint64_t seed) {
  const Random random(seed, Stream::panePoints);
  const std::vector<BorderPoint> onBorder =
      area.round ? std::vector<BorderPoint>{} : pointsOnBorder(area, pattern, random);
  PanePoints pane{area.corners, {}};
  std::vector<Vec2d> border;
  for (const BorderPoint& point : onBorder) {
    const Vec2d a = area.corners[point.edge], b = area.corners[(point.edge + 1) % area.corners.size()];
    border.push_back(a + (b - a) * point.along);
  }
  std::vector<Vec2d> whole = area.corners;
  whole.insert(whole.end(), border.begin(), border.end());
  const std::vector<Vec2d> inside = pointsInside(area, pattern, random, whole);
  pane.points.insert(pane.points.end(), inside.begin(), inside.end());
  auto next = static_cast<std::uint32_t>(pane.points.size());
  pane.points.insert(pane.points.end(), border.begin(), border.end());
  auto point = onBorder.begin();
  for (std::uint32_t corner = 0; corner < area.corners.size(); ++corner) {
    pane.border.push_back(corner);
    for (; point != onBorder.end() && point->edge == corner; ++point) pane.border.push_back(next++);
  }
  return pane;
}

struct PatternFault {
  const Outline& outline;
  std::string operator()(const UniformPoints&) const { return ""; }
  std::string operator()(const BlueNoisePoints&) const { return ""; }
  std::string operator()(const ImpactPoints& pattern) const {
    const std::vector<Vec2d> corners = outlineCorners(outline, std::numeric_limits<double>::infinity());
    const Vec3d size = polygonBounds(corners).size();
    if (pattern.spokes < 3) return fmt::format("must have at least 3 spokes, got {}", pattern.spokes);
    if (!(pattern.finest > 0)) return fmt::format("finest must be above 0, got {}", pattern.finest);
    // The innermost arc lies inside, and so do the rounded places of its points.
    const double room = std::max(2 * pattern.finest, 10 * borderMargin * std::max(size.x, size.y));
    if (PolygonInside(corners, room).contains(pattern.impact)) return "";
    return fmt::format("impact must lie inside the outline, {:g} m or more (twice finest) from it, got [{:g}, {:g}]",
                       room, pattern.impact.x, pattern.impact.y);
  }
};

}  // namespace

std::string patternFault(const PointPattern& pattern, const Outline& outline) {
  return std::visit(PatternFault{outline}, pattern);
}

PanePoints placePoints(const Outline& outline, const PointPattern& pattern, int count, std::uint64_t seed) {
  if (const std::string fault = outlineFault(outline); !fault.empty()) throw InputError("outline: " + fault);
  if (const std::string fault = patternFault(pattern, outline); !fault.empty()) throw InputError("pattern: " + fault);
  const auto* rectangle = std::get_if<RectangleOutline>(&outline);
  if (rectangle != nullptr && std::holds_alternative<UniformPoints>(pattern))
    return rectanglePoints(*rectangle, count, seed);
  const PaneArea area = areaOf(outline, count);
  return std::visit([&](const auto& chosen) { return patternPoints(area, chosen, seed); }, pattern);
}

std::vector<Vec2d> panePoints(double width, double height, int count, int borderCount, std::uint64_t seed) {
  const Random random(seed, Stream::panePoints);
  const double x = width / 2, y = height / 2;
  std::vector<Vec2d> points{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  std::uint64_t draw = 0;
  for (int i = 0; i < count; ++i, draw += 2)
    points.push_back({width * (random.uniform(draw) - 0.5), height * (random.uniform(draw + 1) - 0.5)});
  // One border point at random within each of equal lengths: neither clusters nor a regular pattern.
  const double spacing = 2 * (width + height) / std::max(1, borderCount);
  for (int i = 0; i < borderCount; ++i, ++draw)
    points.push_back(borderPoint(width, height, (i + random.uniform(draw)) * spacing));
  return points;
}

}  // namespace brisance
