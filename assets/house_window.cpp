#include "assets/house_window.h"

namespace brisance::assets {
namespace {

constexpr double sillHeight = 0.12;  // [m]
const Color shadeLight{0.46, 0.49, 0.62}, sunLight{1.12, 0.94, 0.76};
const Color eveningSky{0.50, 0.52, 0.63};

/// Lamps inside, curtains drawn aside, a dim back wall.
Color litRoom(const Vec2d& in, double width, double height, double mood) {
  const double towardsLamp = length(Vec3d{in.x / width - 0.3 * (mood - 0.5), in.y / height - 0.72, 0});
  Color color = mix(Color{1.0, 0.86, 0.56}, Color{0.66, 0.40, 0.18}, smoothStep(0.05, 0.75, towardsLamp));
  const double curtain = smoothStep(0.24 + 0.08 * mood, 0.30 + 0.08 * mood, std::abs(in.x) / width);
  const double fold = 0.5 + 0.5 * std::sin(in.x * 62 + 3 * mood);
  const Color cloth = mix(Color{0.72, 0.42, 0.22}, Color{0.80, 0.66, 0.42}, mood) * (0.62 + 0.30 * fold);
  color = mix(color, cloth, curtain);
  if (mood > 0.7) color = mix(color, Color{0.30, 0.18, 0.10}, 0.8 * within(in.y, 0, 0.25 + 0.08 * std::sin(in.x * 17)));
  return color;
}

/// A dark pane: the room's depth below, the sky's reflection above a wavering line.
Color darkPane(const Vec2d& in, double height, std::uint64_t seed, int number) {
  const double waver = 0.18 * (smoothNoise({in.x * 2.2 + number * 7.0, in.y * 1.4}, seed) - 0.5);
  const double sky = smoothStep(0.35, 0.75, in.y / height + waver + 0.12 * in.x);
  return mix(Color{0.085, 0.095, 0.125}, eveningSky, 0.15 + 0.6 * sky);
}

/// Painted frame, one bar across, one or two upright.
double frameCover(const Window& window, const Vec2d& in) {
  constexpr double frame = 0.07, bar = 0.028;
  const double edge = std::min(window.width / 2 - std::abs(in.x), std::min(in.y, window.height - in.y));
  const double across = std::abs(in.y - 0.52 * window.height);
  return std::max({within(edge, 0, frame), within(across, 0, 0.035), within(std::abs(in.x), 0, bar / 2)});
}

}  // namespace

Color lit(const Color& color, const Place& place) { return color * mix(shadeLight, sunLight, place.sunlight); }

Color wallColor(const HouseFront& house, const Place& place) {
  const double stain = cloudNoise({place.p.x * 0.5, place.p.y * 0.25}, {5, house.seed + 40}) - 0.5;
  const double streak = cloudNoise({place.p.x * 5, place.p.y * 0.35}, {3, house.seed + 50}) - 0.5;
  Color color = house.wall * (1 + 0.10 * (cloudNoise(place.p * 6, {2, house.seed + 60}) - 0.5));
  if (house.isBrick) {
    Brickwork work;
    work.brick = house.wall;
    work.mortar = mix(house.wall, Color{0.62, 0.57, 0.52}, 0.55);
    work.seed = house.seed;
    color = brickColor(place.p, work);
  }
  return lit(color * (1 + 0.45 * stain + 0.22 * streak), place);
}

Color windowColor(const HouseFront& house, const Window& window, const Vec2d& in, const Place& place) {
  const double mood = cellNoise(window.number, 1, house.seed + 7);
  const bool isLit = cellNoise(window.number, 2, house.seed + 7) < 0.42;
  Color glass =
      isLit ? litRoom(in, window.width, window.height, mood) : darkPane(in, window.height, house.seed, window.number);
  if (!isLit && mood > 0.45) {
    const double blind = window.height * (1 - 0.5 * (mood - 0.3));
    glass = mix(glass, lit(Color{0.70, 0.66, 0.58}, place) * 0.75, 0.8 * within(in.y, blind, window.height));
  }
  const Color frame = lit(Color{0.80, 0.78, 0.72}, place) * (isLit ? 0.9 : 0.8);
  Color color = mix(glass, frame, frameCover(window, in));
  // The reveal's shadow: the sun stands to the upper left.
  const double shadow =
      std::max(smoothStep(0.16, 0.0, window.height - in.y), smoothStep(0.12, 0.0, in.x + window.width / 2));
  return color * (1 - 0.55 * shadow * (isLit ? 0.5 : 1));
}

double underSill(const Window& window, const Vec2d& in) {
  const double below = -sillHeight - in.y;
  if (below < 0 || std::abs(in.x) > window.width / 2 + 0.18) return 1;
  return mix(0.55, 1.0, smoothStep(0, 0.35, below));
}

std::optional<Color> surroundColor(const HouseFront& house, const Window& window, const Vec2d& in, const Place& place) {
  constexpr double stone = 0.15;
  const double aside = std::abs(in.x) - window.width / 2, above = in.y - window.height;
  const Color trim = lit(house.trim * (0.93 + 0.14 * cloudNoise(in * 9, {2, house.seed + 70})), place);
  const bool keystone = std::abs(in.x) < 0.13 + 0.06 * above && above >= 0 && above < 0.36;
  if (keystone) return trim * (std::abs(in.x) > 0.11 + 0.06 * above ? 0.8 : 1.1);
  if (above >= 0.22 && above < 0.30 && aside < 0.28) return trim * 1.08;
  if (above >= 0 && above < 0.22 && aside < stone) return trim * (above > 0.19 ? 0.72 : 1.0);
  if (aside < stone && in.y >= 0 && above < 0) return trim * (aside < 0.03 ? 0.80 : in.x < 0 ? 1.05 : 0.95);
  if (in.y < 0 && in.y >= -sillHeight && aside < stone + 0.06) return trim * (in.y > -0.04 ? 1.16 : 0.92);
  return {};
}

}  // namespace brisance::assets
