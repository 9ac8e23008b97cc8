// Where a pane's points lie: they become the corners of its shards.
#pragma once

#include "mesh/outline.h"

namespace brisance {

/// Anywhere alike: shards of all sizes.
struct UniformPoints {
  friend bool operator==(const UniformPoints&, const UniformPoints&) = default;
};
/// No two near each other: even shards. Darts are thrown at a radius that shrinks as room runs out (McCool & Fiume
/// 1992).
struct BlueNoisePoints {
  friend bool operator==(const BlueNoisePoints&, const BlueNoisePoints&) = default;
};
/// As glass breaks under a blow: radial cracks leave the impact, and arcs between them lie ever farther apart.
struct ImpactPoints {
  Vec2d impact;               ///< [m] inside the outline
  int spokes = 24;            ///< radial cracks
  double finest = 0.02;       ///< [m] distance of the innermost arc from the impact
  double irregularity = 0.4;  ///< 0: a spider's web, 1: cracks wander by half of their distance
  friend bool operator==(const ImpactPoints&, const ImpactPoints&) = default;
};
using PointPattern = std::variant<UniformPoints, BlueNoisePoints, ImpactPoints>;

/// What is wrong with a pattern in an outline, in one line; empty where nothing is. Wants an outline without fault.
std::string patternFault(const PointPattern& pattern, const Outline& outline);

/// Points and the outline through some of them.
struct PanePoints {
  std::vector<Vec2d> points;          ///< [m] the outline's corners, then those inside, then further ones on the border
  std::vector<std::uint32_t> border;  ///< counter-clockwise
};

/// Exactly `count` points inside an outline, and on its border as many as suit them. Throws InputError for an outline
/// or a pattern with a fault.
PanePoints placePoints(const Outline& outline, const PointPattern& pattern, int count, std::uint64_t seed);

/// The corners of a width x height rectangle centred on the origin, then `count` points inside it, uniform and seeded.
/// `borderCount` further points lie on the border, so that shards' outer edges vary in length.
std::vector<Vec2d> panePoints(double width, double height, int count, int borderCount, std::uint64_t seed);

}  // namespace brisance
