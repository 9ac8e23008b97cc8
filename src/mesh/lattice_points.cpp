#include "mesh/lattice_points.h"

#include <numeric>

#include "base/check.h"

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

std::vector<std::uint32_t> distinctNodes(const std::vector<LatticePoint>& nodes) {
  std::vector<std::uint32_t> order(nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return nodes[a] != nodes[b] ? nodes[a] < nodes[b] : a < b; });
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return nodes[a] == nodes[b]; }),
              order.end());
  return order;
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
  for (const Vec2d& p : points) {
    const LatticePoint node{nodeOf(p.x, origin.x, step), nodeOf(p.y, origin.y, step)};
    result.nodes.push_back(node);
    result.points.push_back({origin.x + node.x * step, origin.y + node.y * step});
  }
  result.distinct = distinctNodes(result.nodes);
  return result;
}

}  // namespace brisance
