#include "mesh/triangulation.h"

#include "base/check.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

/// Point at a distance along the border of a rectangle about the origin, from its lower left corner, counter-clockwise.
Vec2d borderPoint(double width, double height, double distance) {
  const double x = width / 2, y = height / 2;
  if (distance < width) return {distance - x, -y};
  if (distance < width + height) return {x, distance - width - y};
  if (distance < 2 * width + height) return {x - (distance - width - height), y};
  return {-x, y - (distance - 2 * width - height)};
}

struct Run {
  const LatticePoints& points;
  std::uint64_t seed;
  std::vector<Triangle> operator()(const Trisection&) const { return trisect(points, seed); }
  std::vector<Triangle> operator()(const Delaunay&) const { return delaunay(points); }
};

}  // namespace

std::vector<Vec2d> panePoints(double width, double height, int count, int borderCount, std::uint64_t seed) {
  const Random random(seed, Stream::panePoints);
  const double x = width / 2, y = height / 2;
  std::vector<Vec2d> points{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  std::uint64_t draw = 0;
  for (int i = 0; i < count; ++i, draw += 2)
    points.push_back({width * (random.uniform(draw) - 0.5), height * (random.uniform(draw + 1) - 0.5)});
  // One border point at random within each of equal lengths: neither clusters nor a regular pattern.
  const double spacing = 2 * (width + height) / std::max(1, borderCount);
  for (int i = 0; i < borderCount; ++i, ++draw)
    points.push_back(borderPoint(width, height, (i + random.uniform(draw)) * spacing));
  return points;
}

std::vector<std::uint32_t> hullCorners(const LatticePoints& points) {
  // Andrew's monotone chain: the lower side from left to right, then the upper one back.
  const auto& order = points.distinct;
  const auto& nodes = points.nodes;
  std::vector<std::uint32_t> hull;
  const auto extend = [&](std::uint32_t point, std::size_t chainStart) {
    while (hull.size() >= chainStart + 2 &&
           orientation(nodes[hull[hull.size() - 2]], nodes[hull.back()], nodes[point]) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const std::uint32_t point : order) extend(point, 0);
  if (hull.empty()) return hull;
  const std::size_t upperStart = hull.size() - 1;
  for (auto point = order.rbegin() + 1; point != order.rend(); ++point) extend(*point, upperStart);
  hull.pop_back();
  return hull;
}

FlatMesh triangulate(const std::vector<Vec2d>& points, const Triangulation& method, std::uint64_t seed) {
  LatticePoints lattice = snapToLattice(points);
  if (hullCorners(lattice).size() < 3) throw InputError("triangulation: the points lie on one line, must span an area");
  std::vector<Triangle> triangles = std::visit(Run{lattice, seed}, method);
  return {std::move(lattice.points), std::move(triangles)};
}

}  // namespace brisance
