// What stands in a row of the gas. In an empty box few rows differ, and those stay in the nearest cache.
#pragma once

#include <algorithm>

#include "fluid/fluid_state.h"

namespace brisance {

/// Open shares of a row of faces.
inline const float* openRow(const SolidStamp& solid, int axis, int j, int k) {
  const Grid3<float>& open = solid.openShare.component(axis);
  if (!solid.empty) return &open(0, j, k);
  const auto alike = [&](int n, int along) {  // only the box's own faces differ
    return axis != along || n == 0 ? 0 : n + 1 == open.size[along] ? n : 1;
  };
  return &open(0, alike(j, 1), alike(k, 2));
}

/// Which cells of a row are solid; null where none is.
inline const std::uint8_t* solidsOfRow(const SolidStamp& solid, int j, int k) {
  if (solid.empty) return nullptr;
  const std::uint8_t *inside = &solid.inside(0, j, k), *end = inside + solid.inside.size.x;
  return std::find(inside, end, 1) < end ? inside : nullptr;
}

}  // namespace brisance
