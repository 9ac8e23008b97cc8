// Cracks of a struck pane: spokes from the impact, and arcs whose distance grows as their radius.
#include "mesh/point_patterns.h"

namespace brisance {
namespace {

/// One radial crack.
struct Spoke {
  double angle;   ///< [radians]
  double length;  ///< [m] to the border
};

Vec2d towards(double angle) {
  const SinCos turn = portableSinCos(angle);
  return {turn.cos, turn.sin};
}

/// Evenly around, each off its place by up to a third of their distance.
std::vector<Spoke> spokesOf(const PaneArea& pane, const ImpactPoints& pattern, const Random& random) {
  constexpr double freedom = 0.67;
  const double between = 2 * pi / pattern.spokes;
  std::vector<Spoke> spokes;
  for (int s = 0; s < pattern.spokes; ++s) {
    const double off =
        freedom * pattern.irregularity * (random.uniform(borderDraws + static_cast<std::uint64_t>(s)) - 0.5);
    const double angle = between * (s + 0.5 + off);
    spokes.push_back({angle, distanceToBorder(pane.corners, pattern.impact, towards(angle))});
  }
  return spokes;
}

/// Arcs whose radii grow by a constant factor: their natural logarithms by `step`.
std::vector<Vec2d> web(const PaneArea& pane, const ImpactPoints& pattern, const std::vector<Spoke>& spokes, double step,
                       const Random& random) {
  constexpr double radialFreedom = 0.7, sidewaysFreedom = 0.25;  // of the distance to the next arc, the next spoke
  constexpr double nearBorder = 0.35;  // of the distance between arcs: a point nearer than that makes slivers
  const double between = 2 * pi / pattern.spokes;
  std::vector<Vec2d> points{pattern.impact};
  std::uint64_t draw = 0;
  for (int arc = 0, placed = 1; placed > 0; ++arc) {
    placed = 0;
    for (const Spoke& spoke : spokes) {
      const double outwards = radialFreedom * pattern.irregularity * (random.uniform(draw++) - 0.5);
      const double sideways = sidewaysFreedom * pattern.irregularity * (random.uniform(draw++) - 0.5);
      const double radius = pattern.finest * portableExp(step * (arc + outwards));
      const Vec2d direction = towards(spoke.angle + between * sideways);
      const double reach = distanceToBorder(pane.corners, pattern.impact, direction);
      if (radius * portableExp(nearBorder * step) >= reach) continue;
      ++placed;
      points.push_back(pattern.impact + direction * radius);
    }
  }
  return points;
}

}  // namespace

std::vector<Vec2d> pointsInside(const PaneArea& pane, const ImpactPoints& pattern, const Random& random,
                                const std::vector<Vec2d>&) {
  constexpr double finer = 0.97;  // until there are points enough
  const auto wanted = static_cast<std::size_t>(std::max(0, pane.count));
  const std::vector<Spoke> spokes = spokesOf(pane, pattern, random);
  double steps = 0;
  for (const Spoke& spoke : spokes) steps += std::max(0.0, portableLog(spoke.length / pattern.finest));
  double step = std::max(steps, 1e-3) / std::max(1, pane.count);
  std::vector<Vec2d> points = web(pane, pattern, spokes, step, random);
  while (points.size() < wanted) points = web(pane, pattern, spokes, step *= finer, random);
  // Those too many are the innermost but the impact itself: least is missed there.
  const auto tooMany = static_cast<std::ptrdiff_t>(points.size() - wanted);
  points.erase(points.begin() + (wanted > 0 ? 1 : 0), points.begin() + (wanted > 0 ? 1 : 0) + tooMany);
  return points;
}

std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const ImpactPoints& pattern, const Random& random) {
  constexpr double nearCorner = 0.03;  // share of an edge: a crack so close ends at the corner
  std::vector<BorderPoint> border;
  for (const Spoke& spoke : spokesOf(pane, pattern, random)) {
    const Vec2d end = pattern.impact + towards(spoke.angle) * spoke.length;
    BorderPoint nearest{0, 0};
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t edge = 0; edge < pane.corners.size(); ++edge) {
      const Vec2d a = pane.corners[edge], side = pane.corners[(edge + 1) % pane.corners.size()] - a, off = end - a;
      const double squared = side.x * side.x + side.y * side.y, along = (off.x * side.x + off.y * side.y) / squared;
      const double away = std::abs(off.x * side.y - off.y * side.x) / std::sqrt(squared);
      if (along > 0 && along < 1 && away < gap) gap = away, nearest = {edge, along};
    }
    if (nearest.along > nearCorner && nearest.along < 1 - nearCorner) border.push_back(nearest);
  }
  std::sort(border.begin(), border.end(), [](const BorderPoint& a, const BorderPoint& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.along < b.along;
  });
  return border;
}

}  // namespace brisance
