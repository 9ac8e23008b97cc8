#include "assets/street.h"

#include <array>

#include "assets/house_front.h"

namespace brisance::assets {
namespace {

constexpr double kerb = 2.55, pavement = 2.75, houses = 3.75;  // heights in the picture [m]
constexpr double lampSpacing = 11, firstLamp = 5.3, lampHeight = 4.6;
const Color lampLight{1.0, 0.78, 0.45};

const std::array<HouseFront, 6>& row() {
  static const std::array<HouseFront, 6> all{{
      {-1.2, 6.4, 3, 3, false, {0.80, 0.72, 0.58}, {0.82, 0.78, 0.70}, true, {0.16, 0.27, 0.23}, true, 1.9, 3, 1.0},
      {5.2, 5.0, 3, 2, true, {0.55, 0.27, 0.19}, {0.77, 0.72, 0.63}, false, {0.14, 0.20, 0.34}, false, 2.4, 17, 1.05},
      {10.2, 7.2, 3, 4, true, {0.60, 0.44, 0.28}, {0.80, 0.75, 0.66}, true, {0.36, 0.10, 0.10}, false, 1.6, 29, 0.94},
      {17.4, 4.6, 2, 2, false, {0.66, 0.66, 0.62}, {0.84, 0.82, 0.77}, true, {0.13, 0.17, 0.27}, true, 2.9, 41, 1.04},
      {22.0, 6.6, 3, 3, true, {0.47, 0.23, 0.17}, {0.74, 0.68, 0.58}, true, {0.22, 0.17, 0.12}, false, 2.3, 53, 1.0},
      {28.6, 6.4, 3, 3, false, {0.79, 0.62, 0.49}, {0.83, 0.79, 0.72}, false, {0.30, 0.12, 0.11}, false, 1.8, 67, 0.93},
  }};
  return all;
}

/// The sun is low behind the viewer, to the left: the roofs on this side throw their outline on the other.
double sunlightAt(const Vec2d& p) {
  const double x = p.x + 1.2 * p.y;
  const double block = cellNoise(static_cast<int>(std::floor(x / 5.5)), 0, 7);
  const bool chimney = fraction(x / 5.5) > 0.72 && fraction(x / 5.5) < 0.86;
  const double outline = houses + 6.2 + 2.0 * block + (chimney ? 1.3 : 0);
  return smoothStep(-0.35, 0.35, p.y - outline);
}

Color clearSky(double height) {
  const Color low{0.93, 0.74, 0.63}, middle{0.70, 0.67, 0.74}, high{0.33, 0.45, 0.64};
  const double t = height / 22;
  return t < 0.72 ? mix(low, middle, smoothStep(0.45, 0.75, t)) : mix(middle, high, smoothStep(0.72, 1.12, t));
}

Color skyColor(const Vec2d& p) {
  // Clouds: wide, flat below, lit from the left.
  const Vec2d at{p.x * 0.11, p.y * 0.26};
  const double fill = cloudNoise(at, {6, 201});
  const double towardsSun = cloudNoise(at + Vec2d{-0.10, 0.10}, {6, 201});
  const double cover = smoothStep(0.47, 0.66, fill);
  const double light = std::clamp(0.55 + 3.2 * (fill - towardsSun), 0.0, 1.0);
  const Color cloud = mix(Color{0.56, 0.52, 0.62}, Color{1.0, 0.83, 0.70}, light);
  return mix(clearSky(p.y), cloud, 0.88 * cover);
}

/// Roofs and a steeple further off, pale with distance.
Color backdrop(const Vec2d& p) {
  const double block = std::floor(p.x / 2.3);
  const double slope = 0.5 * std::abs(fraction(p.x / 2.3) - 0.5);
  const double roofs = houses + 12.3 + 1.5 * cellNoise(static_cast<int>(block), 3, 9) - 1.6 * slope;
  const double fromSteeple = std::abs(p.x - 19.6), up = p.y - houses;
  const bool steeple = (fromSteeple < 0.55 && up < 14.2) || (up >= 14.2 && fromSteeple < 0.55 * (17.4 - up) / 3.2);
  const Color haze{0.64, 0.57, 0.62};
  if (steeple) return mix(haze, Color{0.48, 0.42, 0.48}, fromSteeple < 0.1 && up < 14.2 ? 0.9 : 0.55);
  return p.y < roofs ? haze : skyColor(p);
}

Color rowColor(const Vec2d& p) {
  for (const HouseFront& house : row()) {
    const Vec2d in{p.x - house.left, p.y - houses};
    if (in.x < 0 || in.x >= house.width) continue;
    const bool pipe = in.x < 0.10 && in.y < wallTop(house);
    const auto color = houseColor(house, in, sunlightAt(p));
    if (color) return pipe ? mix(*color, Color{0.12, 0.12, 0.14}, 0.55 + 0.3 * std::sin(in.x * 60)) : *color;
  }
  return backdrop(p);
}

/// Warm light from a shop window or lamp that reaches the ground below it, 0 to 1.
double groundGlow(double x) {
  double glow = 0;
  for (const HouseFront& house : row()) {
    const double inHouse = std::min(x - house.left, house.left + house.width - x);
    if (house.hasShop) glow = std::max(glow, smoothStep(-0.6, 1.2, inHouse));
  }
  const double fromLamp = std::abs(x - firstLamp - lampSpacing * std::round((x - firstLamp) / lampSpacing));
  return 0.75 * glow + 0.5 * std::exp(-fromLamp * fromLamp / 3);
}

Color pavementColor(const Vec2d& p) {
  // Flags run towards the viewer: rows grow wider downwards.
  const double depth = (p.y - pavement) / (houses - pavement);
  const double flagRow = std::floor(3 * depth * (1.5 - 0.5 * depth)), inRow = fraction(3 * depth * (1.5 - 0.5 * depth));
  const double column = p.x / 0.9 + 0.37 * flagRow;
  const double tone = 0.86 + 0.24 * cellNoise(static_cast<int>(std::floor(column)), static_cast<int>(flagRow), 5);
  const bool joint = inRow < 0.07 || fraction(column) < 0.03;
  const Color stone = Color{0.37, 0.36, 0.39} * (tone * (joint ? 0.84 : 1) * (0.9 + 0.2 * cloudNoise(p * 3, {3, 61})));
  const double underHouses = smoothStep(0.25, 0.0, houses - p.y);
  const Color lit = stone + Color{0.36, 0.24, 0.10} * (groundGlow(p.x) * (0.25 + 0.75 * depth));
  return lit * (1 - 0.35 * underHouses);
}

/// Asphalt after rain: dull, with the fronts' light drawn out towards the viewer.
Color roadColor(const Vec2d& p) {
  const double depth = p.y / kerb;
  const double stretch = 1.3 / (0.35 + 0.65 * (1 - depth));
  const double ripple = cloudNoise({p.x * 1.3, p.y * 9 * stretch}, {4, 71}) - 0.5;
  const double patch = cloudNoise({p.x * 0.35, p.y * 1.5 * stretch}, {4, 81});
  const Color asphalt = Color{0.155, 0.16, 0.185} * (0.80 + 0.35 * patch + 0.25 * ripple);
  const Vec2d mirrored{p.x + 0.55 * ripple, houses + 0.25 + 3.1 * (kerb - p.y) + 0.9 * ripple};
  const double wet = smoothStep(0.42, 0.62, patch) * 0.34 + 0.10;
  Color color = mix(asphalt, rowColor(mirrored) * 0.9, wet);
  const double gutter = smoothStep(0.16, 0.0, kerb - p.y);
  color = color * (1 - 0.4 * gutter);
  const bool dash = std::abs(p.y - 0.62) < 0.045 && fraction(p.x / 4.4) < 0.5;
  return dash ? mix(color, Color{0.62, 0.60, 0.55}, 0.55 + 0.4 * ripple) : color;
}

Color groundColor(const Vec2d& p) {
  if (p.y >= pavement) return pavementColor(p);
  if (p.y >= kerb)
    return Color{0.44, 0.43, 0.45} * (p.y > pavement - 0.06 ? 1.15 : fraction(p.x / 1.2) < 0.02 ? 0.5 : 0.72);
  return roadColor(p);
}

/// From the foot of the nearest lamp post.
Vec2d fromLampFoot(const Vec2d& p) {
  const double number = std::round((p.x - firstLamp) / lampSpacing);
  return {p.x - firstLamp - lampSpacing * number, p.y - pavement - 0.15};
}

Color withLamps(const Color& behind, const Vec2d& p) {
  const Vec2d in = fromLampFoot(p);
  const double aside = std::abs(in.x);
  const Vec2d toFlame{in.x, in.y - lampHeight};
  const double far = std::sqrt(toFlame.x * toFlame.x + toFlame.y * toFlame.y);
  Color color = behind + lampLight * (0.42 * std::exp(-far * far / 0.5) + 0.16 * std::exp(-far / 1.1));
  const double post = in.y < 0.9 ? 0.11 - 0.03 * in.y : in.y < 1.0 ? 0.12 : 0.05;
  const Color iron = Color{0.075, 0.085, 0.09} + Color{0.10, 0.10, 0.12} * smoothStep(0.0, -0.06, in.x);
  if (in.y >= 0 && in.y < lampHeight - 0.35 && aside < post) return iron;
  if (std::abs(in.y - (lampHeight - 0.55)) < 0.03 && aside < 0.32) return iron;
  const double glass = 0.15 + 0.12 * (toFlame.y + 0.35) / 0.7;
  if (toFlame.y >= -0.35 && toFlame.y < 0.33 && aside < glass)
    return aside > glass - 0.03 || toFlame.y < -0.31 ? iron
                                                     : mix(Color{1, 0.95, 0.78}, lampLight, std::min(1.0, far / 0.4));
  const bool hat = toFlame.y >= 0.33 && toFlame.y < 0.62 && aside < 0.34 * (0.66 - toFlame.y) / 0.33;
  return hat ? iron : color;
}

struct Tree {
  double x, crownHeight, crownWidth;
  std::uint64_t seed;
};

/// Leaves where noise of twig size exceeds what the distance from the crown's middle asks for.
Color withTree(const Color& behind, const Vec2d& p, const Tree& tree) {
  const Vec2d in{p.x - tree.x, p.y - pavement - 0.2};
  const Vec2d crown{in.x / tree.crownWidth, (in.y - tree.crownHeight) / (0.82 * tree.crownWidth)};
  const double inside = 1 - crown.x * crown.x - crown.y * crown.y;
  const double clumps = cloudNoise(in * 1.3, {3, tree.seed}), leaves = cloudNoise(in * 6.5, {3, tree.seed + 10});
  if (inside + 1.5 * (clumps - 0.5) + 1.1 * (leaves - 0.5) > 0.42 && inside > -0.6) {
    const double up = cloudNoise((in + Vec2d{0.12, -0.16}) * 1.3, {3, tree.seed});
    const double light =
        std::clamp(0.40 + 1.7 * (clumps - up) + 0.25 * crown.y - 0.2 * crown.x + 0.9 * (leaves - 0.5), 0.0, 1.0);
    const Color sunny = mix(Color{0.23, 0.27, 0.15}, Color{0.66, 0.55, 0.24}, sunlightAt(p));
    return mix(Color{0.055, 0.085, 0.075}, sunny, light);
  }
  const double bend = 0.09 * std::sin(in.y * 1.1 + static_cast<double>(tree.seed));
  const double trunk = 0.17 - 0.018 * in.y + 0.10 * smoothStep(0.4, 0.0, in.y);
  if (in.y >= 0 && in.y < tree.crownHeight && std::abs(in.x - bend) < trunk) {
    const double bark = cloudNoise({in.x * 16, in.y * 3}, {3, tree.seed + 20});
    return Color{0.17, 0.145, 0.125} * (0.6 + 0.6 * bark + 1.6 * (bend - in.x));
  }
  return behind;
}

}  // namespace

Color streetColor(const Vec2d& p) {
  Color color = p.y < houses ? groundColor(p) : rowColor(p);
  color = withLamps(color, p);
  for (const Tree& tree : {Tree{10.6, 5.3, 2.1, 301}, Tree{22.1, 4.9, 1.8, 331}}) color = withTree(color, p, tree);
  return color;
}

}  // namespace brisance::assets
