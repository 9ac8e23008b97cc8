#include "fluid/gas_points.h"

#include <algorithm>

namespace brisance {

namespace {
/// Gas seen in a cell from a neighbour, along the line of their centres.
struct Sight {
  Vec3i neighbour;
  Vec3d from;        ///< the neighbour's centre
  double depth = 0;  ///< how far into the cell, in cells, nothing stands on that line
};

std::vector<Sight> sightsOf(const GasPointSearch& search, const Vec3i& cell) {
  const LatticeBox& box = search.surfaces.box;
  std::vector<Sight> sights;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Vec3i neighbour = cell;
      neighbour[axis] += side;
      if (!box.contains(neighbour) || search.centreInside(neighbour.x, neighbour.y, neighbour.z)) continue;
      const Vec3d from = box.centre(neighbour);
      const double meeting = search.surfaces.firstMeeting(from, box.centre(cell), cell, neighbour);
      sights.push_back({neighbour, from, std::clamp(meeting - 0.5, 0.0, 0.5)});
    }
  return sights;
}

/// Halfway into the gas that is seen.
Vec3d middleOf(const Sight& sight, const Vec3d& centre) {
  return sight.from + (centre - sight.from) * (0.5 + sight.depth / 2);
}

bool isSeen(const GasPointSearch& search, const std::vector<Sight>& sights, const Vec3i& cell, const Vec3d& point) {
  return std::any_of(sights.begin(), sights.end(), [&](const Sight& sight) {
    return search.surfaces.seesAcross(sight.from, point, cell, sight.neighbour);
  });
}

/// The mean of all places tried that are seen.
bool meanOfSeen(const GasPointSearch& search, const std::vector<Sight>& sights, const Vec3i& cell, Vec3d& mean) {
  const Vec3d centre = search.surfaces.box.centre(cell);
  Vec3d sum;
  int count = 0;
  const auto add = [&](const Vec3d& place) {
    sum += place;
    ++count;
  };
  constexpr double shallow = 1e-6, out = 0.4;  // of a cell
  for (const Sight& sight : sights)
    if (sight.depth > shallow) add(middleOf(sight, centre));
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d place = centre + Vec3d(octant & 1 ? out : -out, octant & 2 ? out : -out, octant & 4 ? out : -out);
    if (isSeen(search, sights, cell, place)) add(place);
  }
  if (count == 0) return false;
  mean = sum / static_cast<double>(count);
  return isSeen(search, sights, cell, mean);
}

/// Where a thin body parts a cell, the side with more room; none where both are alike.
bool deepest(const GasPointSearch& search, const std::vector<Sight>& sights, const Vec3i& cell, Vec3d& point) {
  constexpr double alike = 1e-3;  // of a cell
  const Sight* best = nullptr;
  double second = 0;
  for (const Sight& sight : sights) {
    if (best == nullptr || sight.depth > best->depth) {
      second = best == nullptr ? 0 : best->depth;
      best = &sight;
    } else {
      second = std::max(second, sight.depth);
    }
  }
  if (best == nullptr || best->depth <= second + alike) return false;
  point = middleOf(*best, search.surfaces.box.centre(cell));
  return true;
}
}  // namespace

bool findGasPoint(const GasPointSearch& search, const Vec3i& cell, Vec3d& point) {
  const std::vector<Sight> sights = sightsOf(search, cell);
  return meanOfSeen(search, sights, cell, point) || deepest(search, sights, cell, point);
}

}  // namespace brisance
