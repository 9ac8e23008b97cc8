#include "fluid/triangle_bins.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {
constexpr double rounding = 1e-9;  // of a cell

/// False only where the plane of the triangle surely misses a cell.
bool planeTouches(const Vec3d& corner, const Vec3d& normal, const Vec3d& centre) {
  const double reach = (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) * (0.5 + rounding);
  return std::abs(dot(normal, centre - corner)) <= reach;
}
}  // namespace

TriangleBins::TriangleBins(const LatticeBox& box, std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
    const Corners& t = triangles_[n];
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const Vec3d lower = min(t[0], min(t[1], t[2])), upper = max(t[0], max(t[1], t[2]));
    Vec3i first, last;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::clamp(std::floor(lower[axis] - rounding), 0.0, box.cells[axis] + 0.0));
      last[axis] = static_cast<int>(std::clamp(std::floor(upper[axis] + rounding), -1.0, box.cells[axis] - 1.0));
    }
    for (int k = first.z; k <= last.z; ++k)
      for (int j = first.y; j <= last.y; ++j)
        for (int i = first.x; i <= last.x; ++i)
          if (planeTouches(t[0], normal, box.centre({i, j, k}))) entries_.push_back({box.cellIndex({i, j, k}), n});
  }
  std::sort(entries_.begin(), entries_.end());
}

double meets(const Vec3d& p, const Vec3d& q, const Corners& t) {
  constexpr double apart = 2;
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  const double size = length(normal), pSide = dot(normal, p - t[0]), qSide = dot(normal, q - t[0]);
  const double tolerance = rounding * size;
  if ((pSide > tolerance && qSide > tolerance) || (pSide < -tolerance && qSide < -tolerance)) return apart;
  const Vec3d along = q - p;
  bool positive = true, negative = true;
  for (int n = 0; n < 3; ++n) {
    const Vec3d a = t[n] - p, b = t[(n + 1) % 3] - p;
    const double side = dot(along, cross(a, b));
    const double near = rounding * (length(a) * length(b) + size);
    positive = positive && side >= -near;
    negative = negative && side <= near;
  }
  if (!positive && !negative) return apart;
  const double fall = pSide - qSide;
  return std::abs(fall) <= tolerance ? 0 : std::clamp(pSide / fall, 0.0, 1.0);
}

double Surfaces::firstMeeting(const Vec3d& p, const Vec3d& q, const Vec3i& cell, const Vec3i& neighbour) const {
  double first = 2;
  for (const TriangleBins* set : bins) {
    if (set == nullptr) continue;
    for (const Vec3i& c : {cell, neighbour})
      if (box.contains(c))
        set->forCell(box.cellIndex(c),
                     [&](const Corners& triangle) { first = std::min(first, meets(p, q, triangle)); });
  }
  return first;
}

}  // namespace brisance
