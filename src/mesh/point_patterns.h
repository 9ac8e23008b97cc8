// The patterns behind placePoints().
#pragma once

#include "base/random.h"
#include "mesh/pane_points.h"

namespace brisance {

/// A pane as the patterns see it.
struct PaneArea {
  std::vector<Vec2d> corners;  ///< counter-clockwise
  bool round = false;          ///< its corners are close enough to serve as border points alone
  int count = 0;               ///< points wanted inside
  double spacing = 0;          ///< [m] that so many points have on average; infinite for none
};

/// A point of the border between two corners.
struct BorderPoint {
  std::size_t edge;  ///< from this corner to the next
  double along;      ///< share of the edge
};

/// Draws for border points begin here, so that the points inside do not depend on their number.
constexpr std::uint64_t borderDraws = std::uint64_t{1} << 40;
/// Points inside keep this share of the extent from the border, so that no rounding puts them outside.
constexpr double borderMargin = 1e-7;

std::vector<Vec2d> pointsInside(const PaneArea& pane, const UniformPoints& pattern, const Random& random,
                                const std::vector<Vec2d>& border);
std::vector<Vec2d> pointsInside(const PaneArea& pane, const BlueNoisePoints& pattern, const Random& random,
                                const std::vector<Vec2d>& border);
std::vector<Vec2d> pointsInside(const PaneArea& pane, const ImpactPoints& pattern, const Random& random,
                                const std::vector<Vec2d>& border);

/// Border points in order of edges and along them.
std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const UniformPoints& pattern, const Random& random);
std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const BlueNoisePoints& pattern, const Random& random);
std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const ImpactPoints& pattern, const Random& random);

}  // namespace brisance
