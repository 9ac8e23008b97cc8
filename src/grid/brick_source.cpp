#include "grid/brick_source.h"

namespace brisance {

std::vector<Vec3i> cornersOfBricks(const Vec3i& size) {
  std::vector<Vec3i> corners;
  for (int k = 0; k < size.z; k += brickSide)
    for (int j = 0; j < size.y; j += brickSide)
      for (int i = 0; i < size.x; i += brickSide) corners.emplace_back(i, j, k);
  return corners;
}

}  // namespace brisance
