#include "fracture/clip_triangle.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "base/check.h"

namespace brisance {
namespace {

using Int256 = boost::multiprecision::int256_t;

Int256 wide(Int128 value) {
  const bool negative = value < 0;
  __extension__ using Uint128 = unsigned __int128;
  const Uint128 magnitude = negative ? -static_cast<Uint128>(value) : static_cast<Uint128>(value);
  Int256 result = static_cast<std::uint64_t>(magnitude >> 64);
  result <<= 64;
  result += static_cast<std::uint64_t>(magnitude);
  return negative ? -result : result;
}

bool isNearerExactly(const Vec3<Int128>& share, const Vec3l& row) {
  Int256 sum = 0;
  for (int corner = 0; corner < 3; ++corner) sum += wide(share[corner]) * row[corner];
  return isPositive(sum);
}

/// Where a side of the polygon crosses a plane.
ClipPoint crossing(const ClipSide& side, const ClipSide& plane) {
  ClipPoint point;
  if (side.cell == noCell) {
    const int a = static_cast<int>(side.edge), b = (a + 1) % 3;
    point.share[a] = std::abs(plane.row[b]);
    point.share[b] = std::abs(plane.row[a]);
    return point;
  }
  point.share = meeting(side.row, plane.row);
  if (point.share.x + point.share.y + point.share.z < 0) point.share = -point.share;
  return point;
}

}  // namespace

Vec3<Int128> meeting(const Vec3l& rowA, const Vec3l& rowB) { return cross(Vec3<Int128>(rowA), Vec3<Int128>(rowB)); }

bool isNearer(const Vec3<Int128>& share, const Vec3l& row) {
  double sum = 0, size = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const double term = static_cast<double>(share[corner]) * static_cast<double>(row[corner]);
    sum += term;
    size += std::abs(term);
  }
  // Each term is rounded three times, each sum twice: at most five units of 2^-53 of the sizes.
  constexpr double rounding = 8 * 0x1p-53;
  if (std::abs(sum) > rounding * size) return sum > 0;
  return isNearerExactly(share, row);
}

const std::vector<ClippedTriangle>& TriangleClipper::clip(const std::array<Vec3l, 3>& corners, std::uint32_t start) {
  polygons_.assign(1, {start, {}, {}});
  for (std::size_t next = 0; next < polygons_.size(); ++next) {
    clipToCell(polygons_[next], corners);
    const std::size_t sideCount = polygons_[next].sides.size();
    for (std::size_t side = 0; side < sideCount; ++side) {
      const std::uint32_t cell = polygons_[next].sides[side].cell;
      if (cell != noCell && std::none_of(polygons_.begin(), polygons_.end(),
                                         [&](const ClippedTriangle& polygon) { return polygon.cell == cell; }))
        polygons_.push_back({cell, {}, {}});
    }
  }
  return polygons_;
}

void TriangleClipper::clipToCell(ClippedTriangle& polygon, const std::array<Vec3l, 3>& corners) {
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    polygon.sides.push_back({noCell, edge, {}});
    polygon.points.push_back({});
    polygon.points.back().share[static_cast<int>(edge)] = 1;
  }
  Vec3l here;
  for (int corner = 0; corner < 3; ++corner) here[corner] = diagram_.power(polygon.cell, corners[corner]);
  for (const std::uint32_t other : diagram_.neighbours(polygon.cell)) {
    ClipSide plane{other, 0, {}};
    for (int corner = 0; corner < 3; ++corner)
      plane.row[corner] = diagram_.power(other, corners[corner]) - here[corner];
    if (plane.row.x <= 0 || plane.row.y <= 0 || plane.row.z <= 0) cutOff(polygon, plane);
  }
}

/// Keeps what is nearer to the polygon's cell than to the plane's.
void TriangleClipper::cutOff(ClippedTriangle& polygon, const ClipSide& plane) {
  const std::size_t count = polygon.points.size();
  inside_.clear();
  for (const ClipPoint& point : polygon.points) inside_.push_back(isNearer(point.share, plane.row));
  if (std::find(inside_.begin(), inside_.end(), false) == inside_.end()) return;
  sides_.clear();
  points_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    if (inside_[k]) {
      points_.push_back(polygon.points[k]);
      sides_.push_back(polygon.sides[k]);
      if (inside_[next]) continue;
      points_.push_back(crossing(polygon.sides[k], plane));
      sides_.push_back(plane);
    } else if (inside_[next]) {
      points_.push_back(crossing(polygon.sides[k], plane));
      sides_.push_back(polygon.sides[k]);
    }
  }
  CHECK(!points_.empty(), "a triangle does not meet cell {}", polygon.cell);
  std::swap(polygon.sides, sides_);
  std::swap(polygon.points, points_);
}

}  // namespace brisance
