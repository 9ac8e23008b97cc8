// What house fronts are made of: lit walls, sash windows and the stone around them.
#pragma once

#include <optional>

#include "assets/house_front.h"

namespace brisance::assets {

inline const Color lampLight{1.0, 0.80, 0.47};

/// One place on the front [m], and how much of the evening sun reaches it, 0 to 1.
struct Place {
  Vec2d p;
  double sunlight;
};
/// A colour as the evening lights it: warm in the sun, bluish in the shade.
Color lit(const Color& color, const Place& place);

Color wallColor(const HouseFront& house, const Place& place);

/// A sash window from the middle of its sill.
struct Window {
  double width, height;
  int number;
};
/// `in` is counted from the middle of the sill [m].
Color windowColor(const HouseFront& house, const Window& window, const Vec2d& in, const Place& place);
/// Stone around a window with a keystone, and the sill. Nothing outside.
std::optional<Color> surroundColor(const HouseFront& house, const Window& window, const Vec2d& in, const Place& place);
/// What the shadow under a sill leaves of the light, 1 outside it.
double underSill(const Window& window, const Vec2d& in);

}  // namespace brisance::assets
