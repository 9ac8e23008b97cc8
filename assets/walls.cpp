#include "assets/walls.h"

namespace brisance::assets {
namespace {

/// Which brick a place belongs to, and where in it.
struct BrickPlace {
  int column, row;  ///< wrapped where the wall repeats
  Vec2d in;         ///< from the middle of the brick [m]
};

BrickPlace brickAt(const Vec2d& p, const Brickwork& work) {
  const double row = std::floor(p.y / work.course);
  const double shifted = p.x / work.length + (static_cast<long>(row) % 2 == 0 ? 0.0 : 0.5);
  const double column = std::floor(shifted);
  const auto wrapped = [](double cell, int period) {
    const int remainder = static_cast<int>(cell) % period;
    return remainder < 0 ? remainder + period : remainder;
  };
  return {wrapped(column, work.bricksAcross),
          wrapped(row, work.courses),
          {(shifted - column - 0.5) * work.length, p.y - (row + 0.5) * work.course}};
}

/// Fired brick: most near the middle colour, some dark and bluish from the kiln's hot side, a few pale.
Color firedColor(const BrickPlace& place, const Brickwork& work) {
  const double kind = cellNoise(place.column, place.row, work.seed);
  const double tone = cellNoise(place.column, place.row, work.seed + 1) - 0.5;
  Color color = work.brick * (1 + 0.30 * work.variety * tone);
  if (kind > 0.86) color = mix(color, work.brick * 0.55 + Color{0.02, 0.02, 0.05}, 0.75 * work.variety);
  if (kind < 0.10) color = mix(color, work.brick * 1.18 + Color{0.07, 0.06, 0.03}, 0.7 * work.variety);
  const double hue = cellNoise(place.column, place.row, work.seed + 2) - 0.5;
  return color + Color{0.02, 0.035, 0.01} * (hue * work.variety);
}

/// Distance into the brick from its nearest edge [m]; below 0 in the joint.
double depthInBrick(const BrickPlace& place, const Brickwork& work) {
  const double halfLength = (work.length - work.joint) / 2, halfHeight = (work.course - work.joint) / 2;
  const double dx = halfLength - std::abs(place.in.x), dy = halfHeight - std::abs(place.in.y);
  return std::min(dx, dy);
}

}  // namespace

Color brickColor(const Vec2d& p, const Brickwork& work) {
  const BrickPlace place = brickAt(p, work);
  const double inBrick = smoothStep(-0.002, 0.002, depthInBrick(place, work));
  return mix(work.mortar, firedColor(place, work), inBrick);
}

Color brickTexture(const Vec2d& p) {
  constexpr int across = 10, courses = 30;
  constexpr double size = brickTextureSize;
  Brickwork work;
  work.brick = {0.47, 0.225, 0.155};
  work.mortar = {0.46, 0.425, 0.375};
  work.bricksAcross = across;
  work.courses = courses;
  work.seed = 11;
  // Worn edges: the place is pushed about by noise before it is looked up.
  const Vec2d unit = p * (1 / size);
  const Vec2d worn =
      p + Vec2d{cloudNoise(unit * 48, {3, 21, 48}) - 0.5, cloudNoise(unit * 48, {3, 31, 48}) - 0.5} * 0.013;
  const BrickPlace place = brickAt(worn, work);
  const double depth = depthInBrick(place, work);
  const double inBrick = smoothStep(-0.0015, 0.0035, depth);
  const double grain = cloudNoise(unit * 96, {3, 41, 96}) - 0.5;
  const double blotch = cloudNoise(unit * 24, {4, 51, 24}) - 0.5;
  Color brick = firedColor(place, work) * (1 + 0.45 * grain + 0.35 * blotch);
  // Light from above: the upper edge of a brick catches it, the joint below lies in shade.
  const double edge = smoothStep(0.012, 0.0, depth);
  brick = brick * (1 + edge * (place.in.y > 0 ? 0.16 : -0.22));
  const double jointShade = place.in.y < 0 ? 0.80 : 0.62;
  const Color mortar = work.mortar * (jointShade * (1 + 0.5 * grain));
  Color color = mix(mortar, brick, inBrick);
  // Soot in large soft stains, and the white bloom of salts in a few places.
  const double soot = smoothStep(0.50, 0.78, cloudNoise(unit * 4, {5, 61, 4}));
  const double bloom = smoothStep(0.60, 0.80, cloudNoise(unit * 6, {5, 71, 6})) * smoothStep(0.3, 0.7, grain + 0.5);
  color = mix(color, color * 0.74, soot);
  return mix(color, Color{0.62, 0.58, 0.53}, 0.20 * bloom);
}

Color plasterTexture(const Vec2d& p) {
  const Vec2d unit = p * (1 / plasterTextureSize);
  const double patches = cloudNoise(unit * 3, {5, 81, 3}) - 0.5;
  const double strokes = cloudNoise({unit.x * 20 + 2 * patches, unit.y * 20 - 3 * patches}, {3, 91, 20}) - 0.5;
  const double grain = cloudNoise(unit * 128, {2, 101, 128}) - 0.5;
  Color color = Color{0.235, 0.215, 0.20} * (1 + 0.45 * patches + 0.16 * strokes + 0.10 * grain);
  // Hairline cracks: where a slow noise crosses its middle, in some places only.
  const double level = cloudNoise(unit * 3, {6, 111, 3}) - 0.5;
  const double where = smoothStep(0.54, 0.66, cloudNoise(unit * 3, {3, 121, 3}));
  const double crack = smoothStep(0.006, 0.0, std::abs(level)) * where;
  return color * (1 - 0.45 * crack);
}

}  // namespace brisance::assets
