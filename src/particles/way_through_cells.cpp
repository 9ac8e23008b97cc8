#include "particles/way_through_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace brisance {

WayThroughCells::WayThroughCells(const GasAround& gas)
    : openShare_(gas.openShare),
      periodic_(gas.periodic),
      empty_(gas.empty),
      cells_(openShare_.cells()),
      corner_(openShare_.u.origin - Vec3d(0, .5, .5) * openShare_.u.cellSize),
      cellSize_(openShare_.u.cellSize),
      perCell_(1 / cellSize_) {}

/// The usual way: at most one cell along each axis, inside the box, with nothing between. All three faces are looked
/// at, crossed or not, since a branch for each would be guessed wrong every third time.
bool WayThroughCells::toFreeNeighbour(const CellBlock& from, const CellBlock& to, int n) const {
  const int begin[3] = {from.along[0][n], from.along[1][n], from.along[2][n]},
            end[3] = {to.along[0][n], to.along[1][n], to.along[2][n]};
  bool near = true;
  for (int axis = 0; axis < 3; ++axis)
    near = near & (end[axis] >= 0) & (end[axis] < cells_[axis]) & (std::abs(end[axis] - begin[axis]) <= 1);
  if (!near) return false;
  const auto upper = [&](int axis) { return std::max(begin[axis], end[axis]); };
  const int y = std::clamp(begin[1], 0, cells_.y - 1), z = std::clamp(begin[2], 0, cells_.z - 1);
  const float open[3] = {openShare_.u(upper(0), y, z), openShare_.v(end[0], upper(1), z),
                         openShare_.w(end[0], end[1], upper(2))};
  bool free = true;
  for (int axis = 0; axis < 3; ++axis) free = free & ((begin[axis] == end[axis]) | (open[axis] != 0));
  return free;
}

bool WayThroughCells::search(int n, const PlaceBlock& place, PlaceBlock& goal) const {
  constexpr double justShort = 1e-6;  // of a cell
  double p[3];
  for (int axis = 0; axis < 3; ++axis) p[axis] = (place.along[axis][n] - corner_[axis]) * perCell_;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& open = openShare_.component(axis);
    int cell[3];  // of a place outside the box the nearest
    for (int a = 0; a < 3; ++a) cell[a] = static_cast<int>(std::min(std::max(0.0, p[a]), cells_[a] - 1.0));
    double end = (goal.along[axis][n] - corner_[axis]) * perCell_;
    const bool forward = end > p[axis];
    while (forward ? cell[axis] + 1 <= end : cell[axis] > end) {
      const int face = cell[axis] + (forward ? 1 : 0);
      int at[3] = {cell[0], cell[1], cell[2]};
      at[axis] = face;
      if (open(at[0], at[1], at[2]) == 0) {
        end = face + (forward ? -justShort : justShort);
        break;
      }
      cell[axis] += forward ? 1 : -1;
      if (cell[axis] >= 0 && cell[axis] < cells_[axis]) continue;
      if (!periodic_[axis]) return false;
      const int period = forward ? -cells_[axis] : cells_[axis];
      cell[axis] += period;
      end += period;
    }
    p[axis] = end;
  }
  for (int axis = 0; axis < 3; ++axis) {
    goal.along[axis][n] = corner_[axis] + p[axis] * cellSize_;
    if (!(p[axis] >= 0 && p[axis] < cells_[axis])) return false;
  }
  return true;
}

}  // namespace brisance
