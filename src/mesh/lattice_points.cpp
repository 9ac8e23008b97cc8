#include "mesh/lattice_points.h"

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int latticeBits = 30;

/// Power of two such that `extent` is at most 2^latticeBits steps; 1 where all points coincide.
double latticeStep(double extent) {
  if (extent == 0) return 1;
  int exponent = 0;
  std::frexp(extent, &exponent);
  return std::ldexp(1.0, exponent - latticeBits);
}

std::int32_t nodeOf(double x, double origin, double step) {
  return static_cast<std::int32_t>(std::lround((x - origin) / step));
}

/// A node's lexicographic place in one number, and the point on it.
struct PlacedPoint {
  std::uint64_t place;
  std::uint32_t point;
  friend bool operator<(const PlacedPoint& a, const PlacedPoint& b) {
    return a.place != b.place ? a.place < b.place : a.point < b.point;
  }
};

/// Halves sorted on threads of their own, then merged.
void sortInHalves(std::vector<PlacedPoint>& order) {
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  parallelFor(0, 2, 1, [&](std::int64_t begin, std::int64_t end) {
    if (begin == 0) std::sort(order.begin(), middle);
    if (end == 2) std::sort(middle, order.end());
  });
  std::inplace_merge(order.begin(), middle, order.end());
}

std::vector<std::uint32_t> distinctNodes(const std::vector<LatticePoint>& nodes) {
  std::vector<PlacedPoint> order(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    order[i] = {static_cast<std::uint64_t>(nodes[i].x) << 32 | static_cast<std::uint64_t>(nodes[i].y), i};
  sortInHalves(order);
  std::vector<std::uint32_t> distinct;
  distinct.reserve(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || order[i].place != order[i - 1].place) distinct.push_back(order[i].point);
  return distinct;
}

}  // namespace

LatticePoints snapToLattice(const std::vector<Vec2d>& points) {
  Box3 box;
  for (const Vec2d& p : points) {
    CHECK(std::isfinite(p.x) && std::isfinite(p.y), "point ({}, {})", p.x, p.y);
    box.include({p.x, p.y, 0});
  }
  const double step = points.empty() ? 1 : latticeStep(std::max(box.size().x, box.size().y));
  // The origin is a multiple of the step, so that every place below is exact.
  const Vec2d origin{std::round(box.lower.x / step) * step, std::round(box.lower.y / step) * step};
  LatticePoints result;
  result.nodes.resize(points.size());
  result.points.resize(points.size());
  constexpr std::int64_t block = 1 << 14;
  parallelFor(0, static_cast<std::int64_t>(points.size()), block, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const LatticePoint node{nodeOf(points[i].x, origin.x, step), nodeOf(points[i].y, origin.y, step)};
      result.nodes[i] = node;
      result.points[i] = {origin.x + node.x * step, origin.y + node.y * step};
    }
  });
  result.distinct = distinctNodes(result.nodes);
  return result;
}

}  // namespace brisance
