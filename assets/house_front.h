// An old town house seen from in front.
#pragma once

#include <optional>

#include "assets/walls.h"

namespace brisance::assets {

struct HouseFront {
  double left = 0, width = 6;  ///< [m]
  int storeys = 3;             ///< above the ground floor
  int bays = 3;                ///< windows side by side
  bool isBrick = true;         ///< else plaster
  Color wall;
  Color trim;           ///< stone around windows, cornice
  bool hasShop = true;  ///< else a front door and windows
  Color paint;          ///< of the shop front or door
  bool hasAwning = false;
  double roofHeight = 1.8;  ///< [m] of slates above the cornice
  std::uint64_t seed = 1;
  double tallness = 1;  ///< scales the storeys' heights
};

double wallTop(const HouseFront& house);  ///< [m] above the pavement

/// What is seen at p [m], from the house's lower left corner; nothing where the sky is. `sunlight` is how much of the
/// evening sun reaches the place, 0 to 1.
std::optional<Color> houseColor(const HouseFront& house, const Vec2d& p, double sunlight);

}  // namespace brisance::assets
