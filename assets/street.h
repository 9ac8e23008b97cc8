// The other side of the street in the evening, as a window mirrors it.
#pragma once

#include "assets/painting.h"

namespace brisance::assets {

constexpr double streetWidth = 33;  ///< [m] across the picture
/// At p [m] from the picture's lower left corner.
Color streetColor(const Vec2d& p);

}  // namespace brisance::assets
