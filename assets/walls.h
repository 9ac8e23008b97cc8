// Walls: brickwork and plaster.
#pragma once

#include "assets/painting.h"

namespace brisance::assets {

/// How bricks are laid and coloured.
struct Brickwork {
  Color brick{0.50, 0.24, 0.17};  ///< the middle of the bricks' colours
  Color mortar{0.52, 0.48, 0.43};
  double variety = 1;    ///< of the bricks' colours
  double length = 0.24;  ///< [m] with its joint
  double course = 0.08;  ///< [m] with its joint
  double joint = 0.012;  ///< [m]
  std::uint64_t seed = 1;
  int bricksAcross = noRepeat;  ///< after so many bricks the wall repeats
  int courses = noRepeat;       ///< even
};
/// A wall seen from in front, at p [m].
Color brickColor(const Vec2d& p, const Brickwork& work);

/// An old brick wall, seamless.
Color brickTexture(const Vec2d& p);
constexpr double brickTextureSize = 2.4;  ///< [m]
/// Dark plaster of a room, seamless.
Color plasterTexture(const Vec2d& p);
constexpr double plasterTextureSize = 2;  ///< [m]

}  // namespace brisance::assets
