#include "assets/house_front.h"

#include "assets/house_window.h"

namespace brisance::assets {
namespace {

constexpr double groundFloor = 3.7;    // [m]
constexpr double corniceHeight = 0.5;  // [m]
constexpr double storeyHeights[] = {3.2, 2.9, 2.5, 2.3};

double storeyHeight(const HouseFront& house, int storey) { return house.tallness * storeyHeights[storey]; }

double floorOf(const HouseFront& house, int storey) {
  double y = groundFloor;
  for (int i = 0; i < storey; ++i) y += storeyHeight(house, i);
  return y;
}

std::optional<Color> storeyWindow(const HouseFront& house, int storey, const Place& place) {
  const double bay = house.width / house.bays, height = storeyHeight(house, storey);
  const auto column = static_cast<int>(place.p.x / bay);
  const Window window{std::min(1.2, 0.5 * bay), (storey == 0 ? 0.64 : 0.58) * height, 16 * storey + column};
  const Vec2d in{place.p.x - (column + 0.5) * bay, place.p.y - floorOf(house, storey) - 0.24 * height};
  if (std::abs(in.x) < window.width / 2 && in.y >= 0 && in.y < window.height)
    return windowColor(house, window, in, place);
  if (const auto surround = surroundColor(house, window, in, place)) return surround;
  if (const double shade = underSill(window, in); shade < 1) return wallColor(house, place) * shade;
  return {};
}

Color upperWall(const HouseFront& house, const Place& place) {
  int storey = 0;
  while (storey + 1 < house.storeys && place.p.y >= floorOf(house, storey + 1)) ++storey;
  if (const auto window = storeyWindow(house, storey, place)) return *window;
  const double overFloor = place.p.y - floorOf(house, storey), below = floorOf(house, storey + 1) - place.p.y;
  if (overFloor < 0.14) return lit(house.trim, place) * (overFloor > 0.10 ? 1.12 : 0.95);
  // Shade under the band above, and at the joints of the houses.
  const double bandShade = smoothStep(0.35, 0.0, below),
               cornerShade = smoothStep(0.25, 0.0, std::min(place.p.x, house.width - place.p.x));
  return wallColor(house, place) * (1 - 0.28 * bandShade - 0.18 * cornerShade);
}

Color corniceColor(const HouseFront& house, const Place& place) {
  const double up = place.p.y - wallTop(house);
  const Color trim = lit(house.trim, place);
  if (up < 0.10) return trim * 0.72;
  if (up < 0.26) return trim * (fraction(place.p.x / 0.24) < 0.55 ? 0.98 : 0.50);
  if (up < 0.31) return trim * 0.66;
  return trim * (up < 0.44 ? 1.02 : 1.18);
}

Color slates(const HouseFront& house, const Place& place) {
  constexpr double course = 0.16, slate = 0.28;
  const double up = place.p.y - wallTop(house) - corniceHeight;
  const double row = std::floor(up / course), column = std::floor(place.p.x / slate + 0.5 * fraction(row / 2) * 2);
  const double tone = 0.86 + 0.30 * cellNoise(static_cast<int>(column), static_cast<int>(row), house.seed + 5);
  const double lower = smoothStep(0.25, 0.0, fraction(up / course));
  const double moss = smoothStep(0.55, 0.75, cloudNoise(place.p * 0.9, {4, house.seed + 9}));
  const Color base = mix(Color{0.31, 0.32, 0.37}, Color{0.34, 0.35, 0.25}, 0.6 * moss);
  return lit(base * (tone * (1 - 0.35 * lower) * (1 - 0.08 * up)), place);
}

/// A chimney stack of brick with its pots at each end of the roof.
std::optional<Color> chimneyColor(const HouseFront& house, const Place& place) {
  constexpr double stackWidth = 0.95, stackHeight = 1.3, cap = 0.14, potHeight = 0.5;
  const double base = wallTop(house) + corniceHeight + 0.45 * house.roofHeight;
  const double x = house.width - stackWidth - 0.15, up = place.p.y - base, in = place.p.x - x;
  if (in < -0.06 || in > stackWidth + 0.06 || up < 0) return {};
  const Color brick = lit(Color{0.40, 0.25, 0.19}, place) * (in < 0.3 * stackWidth ? 1.1 : 0.85);
  if (up < stackHeight) {
    if (in < 0 || in > stackWidth) return {};
    return brick * (fraction(up / 0.08) < 0.16 ? 1.2
                                               : 0.88 + 0.24 * cellNoise(static_cast<int>(in / 0.24),
                                                                         static_cast<int>(up / 0.08), house.seed));
  }
  if (up < stackHeight + cap) return brick * 1.2;
  const double pot = fraction(in / (stackWidth / 3)) - 0.5;
  const double taper = 0.34 - 0.10 * (up - stackHeight - cap);
  if (up < stackHeight + cap + potHeight && std::abs(pot) < taper && in > 0 && in < stackWidth)
    return lit(Color{0.58, 0.32, 0.20}, place) * (1.05 - 0.9 * (pot + 0.2));
  return {};
}

/// Dormer window in the slates, on steep roofs only.
std::optional<Color> dormerColor(const HouseFront& house, const Place& place) {
  constexpr double halfWidth = 0.55, height = 1.15, gable = 0.42;
  if (house.roofHeight < 2) return {};
  const double bay = house.width / house.bays;
  const auto column = static_cast<int>(place.p.x / bay);
  if (column != (house.bays - 1) / 2) return {};
  const Vec2d in{place.p.x - (column + 0.5) * bay, place.p.y - wallTop(house) - corniceHeight - 0.15};
  if (in.y < 0 || std::abs(in.x) > halfWidth + 0.12) return {};
  const double roofLine = height + gable * (1 - std::abs(in.x) / (halfWidth + 0.12));
  if (in.y > roofLine) return {};
  if (in.y > roofLine - 0.12) return lit(Color{0.25, 0.26, 0.31}, place);
  if (std::abs(in.x) > halfWidth) return {};
  const Window window{0.72, 0.9, 100 + column};
  if (std::abs(in.x) < window.width / 2 && in.y > 0.12 && in.y < 0.12 + window.height)
    return windowColor(house, window, {in.x, in.y - 0.12}, place);
  return lit(house.trim * 0.92, place);
}

std::optional<Color> roofColor(const HouseFront& house, const Place& place) {
  const double up = place.p.y - wallTop(house) - corniceHeight;
  if (const auto dormer = dormerColor(house, place)) return dormer;
  if (up < house.roofHeight) return slates(house, place);
  if (up < house.roofHeight + 0.12) return lit(Color{0.42, 0.28, 0.22}, place);
  return {};
}

/// Strokes that read as letters from across the road.
double lettering(const HouseFront& house, const Vec2d& in) {
  constexpr double cell = 0.27, height = 0.30, stroke = 0.055;
  const auto letters = 6 + static_cast<int>(5 * cellNoise(1, 1, house.seed + 3));
  const double x = in.x + 0.5 * cell * letters, column = std::floor(x / cell);
  if (column < 0 || column >= letters || in.y < 0 || in.y > height) return 0;
  const auto letter = static_cast<int>(column);
  const auto has = [&](int part) { return cellNoise(letter, part, house.seed + 4) < 0.62; };
  const double u = x - column * cell, v = in.y;
  if (u > 0.20) return 0;
  const bool upright = (u < stroke) || (u > 0.20 - stroke && has(1));
  const bool across =
      (v > height - stroke && has(2)) || (std::abs(v - height / 2) < stroke / 2 && has(3)) || (v < stroke && has(4));
  return upright || across ? 1 : 0;
}

/// Goods on shelves before a bright back wall.
Color shopWindow(const HouseFront& house, const Vec2d& in) {
  const double brightness = 0.80 + 0.20 * smoothStep(0, 1.8, in.y);
  Color color = Color{1.0, 0.83, 0.53} * (brightness - 0.14 * cloudNoise(in * 1.5, {3, house.seed + 80}));
  constexpr double shelf = 0.62;
  const auto row = static_cast<int>(in.y / shelf), item = static_cast<int>(std::floor(in.x / 0.21));
  const double size = cellNoise(item, row, house.seed + 81);
  const double top = shelf * (0.20 + 0.55 * size), over = in.y - row * shelf;
  const double side = std::abs(fraction(in.x / 0.21) - 0.5);
  const Color goods = mix(mix(Color{0.55, 0.18, 0.12}, Color{0.18, 0.30, 0.34}, cellNoise(item, row, house.seed + 82)),
                          Color{0.62, 0.50, 0.22}, cellNoise(item, row, house.seed + 83));
  if (row < 2 && size > 0.15 && over < top && side < 0.34 + 0.1 * size) color = goods * (1.0 - 0.5 * side);
  if (over < 0.05) color = Color{0.42, 0.27, 0.14};
  return color;
}

Color doorColor(const HouseFront& house, const Vec2d& in, const Place& place) {
  if (in.y > 2.15)
    return mix(lampLight, lit(house.trim, place), within(std::abs(fraction(in.x / 0.32) - 0.5), 0.44, 0.5));
  const bool groove = std::abs(std::abs(in.x) - 0.06) < 0.012 || std::abs(fraction(in.y / 0.72) - 0.08) < 0.02;
  const bool knob = std::abs(in.x - 0.33) < 0.035 && std::abs(in.y - 1.05) < 0.035;
  if (knob) return {0.80, 0.64, 0.32};
  return lit(house.paint, place) * (groove ? 0.62 : 0.95 + 0.12 * smoothStep(-0.5, 0.5, -in.x));
}

Color awningColor(const HouseFront& house, const Place& place, double drop) {
  const bool stripe = fraction(place.p.x / 0.5) < 0.5;
  const Color cloth = stripe ? Color{0.82, 0.77, 0.67} : mix(house.paint, Color{0.55, 0.12, 0.10}, 0.5) * 1.15;
  return lit(cloth, place) * (1.18 - 0.35 * drop);
}

Color shopFront(const HouseFront& house, const Place& place) {
  constexpr double fascia = 2.85, fasciaTop = 3.42, stall = 0.55, pilaster = 0.28;
  const double fromEnd = std::min(place.p.x, house.width - place.p.x), y = place.p.y;
  const Color paint = lit(house.paint, place);
  if (y > fasciaTop) return lit(house.trim, place) * (y > groundFloor - 0.08 ? 1.14 : 0.86);
  const double awningDrop = (fascia - y) / 0.85, scallop = 0.09 * std::abs(std::sin(place.p.x * pi / 0.5));
  if (house.hasAwning && awningDrop > 0 && awningDrop < 0.88 + scallop && fromEnd > 0.2)
    return awningColor(house, place, awningDrop);
  if (y > fascia) {
    const double letter = lettering(house, {place.p.x - house.width / 2, y - fascia - 0.13});
    return mix(paint * (y > fasciaTop - 0.05 ? 1.35 : 0.92), Color{0.86, 0.70, 0.38}, letter);
  }
  if (fromEnd < pilaster) return paint * (std::abs(fromEnd - pilaster / 2) < 0.05 ? 0.78 : 1.12);
  const double door = place.p.x - 0.68 * house.width;
  if (std::abs(door) < 0.62) return std::abs(door) < 0.5 ? doorColor(house, {door, y}, place) : paint * 0.8;
  if (y < stall)
    return paint * (std::abs(fraction(place.p.x / 0.9) - 0.5) > 0.44 || y < 0.1 || y > stall - 0.08 ? 0.72 : 1.0);
  const bool bar = std::abs(fraction(place.p.x / 1.1) - 0.5) > 0.475 || std::abs(y - 2.2) < 0.03 || y < stall + 0.06;
  if (bar) return paint * 0.95;
  const Color window = shopWindow(house, {place.p.x, y - stall});
  return house.hasAwning ? window * (1 - 0.25 * smoothStep(1.2, 2.3, y)) : window;
}

/// Banded stone with a door and tall windows.
Color dwellingFront(const HouseFront& house, const Place& place) {
  const double bay = house.width / house.bays, y = place.p.y;
  const auto column = static_cast<int>(place.p.x / bay);
  const Vec2d in{place.p.x - (column + 0.5) * bay, y - 0.25};
  if (column == house.bays - 1) {
    if (std::abs(in.x) < 0.5 && in.y >= 0 && in.y < 2.65) return doorColor(house, in, place);
    if (std::abs(in.x) < 0.72 && in.y < 2.95)
      return lit(house.trim, place) * (in.y < 0 ? (y > 0.12 ? 0.9 : 0.75) : std::abs(in.x) < 0.55 ? 0.7 : 1.04);
  } else {
    const Window window{std::min(1.25, 0.5 * bay), 1.95, 200 + column};
    const Vec2d inWindow{in.x, y - 1.0};
    if (std::abs(in.x) < window.width / 2 && inWindow.y >= 0 && inWindow.y < window.height)
      return windowColor(house, window, inWindow, place);
    if (const auto surround = surroundColor(house, window, inWindow, place)) return *surround;
  }
  const bool joint = fraction(y / 0.42) < 0.07;
  const double stain = 0.8 + 0.3 * cloudNoise(place.p * 0.8, {4, house.seed + 90});
  return lit(mix(house.trim, house.wall, 0.35), place) * (stain * (joint ? 0.62 : 0.95));
}

}  // namespace

double wallTop(const HouseFront& house) { return floorOf(house, house.storeys); }

std::optional<Color> houseColor(const HouseFront& house, const Vec2d& p, double sunlight) {
  const Place place{p, sunlight};
  if (p.y >= wallTop(house) + corniceHeight) {
    const auto chimney = chimneyColor(house, place);
    return chimney ? chimney : roofColor(house, place);
  }
  if (p.y >= wallTop(house)) return corniceColor(house, place);
  const double corniceShadow = smoothStep(0.7, 0.0, wallTop(house) - p.y);
  const Color front = p.y >= groundFloor ? upperWall(house, place)
                      : house.hasShop    ? shopFront(house, place)
                                         : dwellingFront(house, place);
  return front * (1 - 0.42 * corniceShadow);
}

}  // namespace brisance::assets
