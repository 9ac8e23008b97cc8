#include "render/gas_bricks.h"

#include <algorithm>

namespace brisance {
GasSample GasBrick::at(const Vec3f& cellsIn) const {
  const auto cell = [](float place) { return std::clamp(static_cast<int>(place), 0, cells - 1); };
  const auto share = [](float place, int first) { return std::clamp(place - static_cast<float>(first), 0.0f, 1.0f); };
  const int x = cell(cellsIn.x), y = cell(cellsIn.y), z = cell(cellsIn.z);
  return between(index(x, y, z), share(cellsIn.x, x), share(cellsIn.y, y), share(cellsIn.z, z));
}

void BrickMemory::reserve(std::int64_t count) {
  if (room >= count) return;
  bricks.reset();
  room = count + count / 2;  // a growing cloud needs more in the next frame; untouched pages cost nothing
  bricks.reset(Allocator().allocate(static_cast<std::size_t>(room)));
}

}  // namespace brisance
