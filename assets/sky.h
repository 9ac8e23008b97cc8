// A sky of all directions, for image-based light.
#pragma once

#include "base/math.h"

namespace brisance::assets {

/// Light from a unit direction, y up: a morning sky with a low sun behind haze, above dark ground.
Vec3f skyLight(const Vec3d& direction);

}  // namespace brisance::assets
