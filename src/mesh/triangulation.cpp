#include "mesh/triangulation.h"

#include "base/check.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

struct Run {
  const LatticePoints& points;
  const std::vector<std::uint32_t>& hull;
  std::uint64_t seed;
  std::vector<Triangle> operator()(const Trisection&) const { return trisect(points, hull, seed); }
  std::vector<Triangle> operator()(const Delaunay&) const { return delaunay(points); }
};

struct RunWithin {
  const LatticePoints& points;
  const std::vector<std::uint32_t>& border;
  std::uint64_t seed;
  std::vector<Triangle> operator()(const Trisection&) const { return trisect(points, border, seed); }
  std::vector<Triangle> operator()(const Delaunay&) const {
    return withinBorder(delaunay(points), points.nodes, border);
  }
};

Int128 twiceArea(const std::vector<LatticePoint>& nodes, const std::vector<std::uint32_t>& polygon) {
  Int128 sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += orientation(nodes[polygon[0]], nodes[polygon[i]], nodes[polygon[i + 1]]);
  return sum;
}

/// The border by the first point on each node, none twice in a row.
std::vector<std::uint32_t> distinctBorder(const LatticePoints& points, const std::vector<std::uint32_t>& border) {
  const auto byNode = [&](std::uint32_t a, std::uint32_t b) { return points.nodes[a] < points.nodes[b]; };
  std::vector<std::uint32_t> result;
  for (const std::uint32_t point : border) {
    const std::uint32_t first = *std::lower_bound(points.distinct.begin(), points.distinct.end(), point, byNode);
    if (result.empty() || result.back() != first) result.push_back(first);
  }
  if (result.size() > 1 && result.front() == result.back()) result.pop_back();
  return result;
}

}  // namespace

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
  const std::vector<std::uint32_t> hull = hullCorners(lattice);
  if (hull.size() < 3) throw InputError("triangulation: the points lie on one line, must span an area");
  std::vector<Triangle> triangles = std::visit(Run{lattice, hull, seed}, method);
  return {std::move(lattice.points), std::move(triangles)};
}

FlatMesh triangulatePane(const PanePoints& pane, const Triangulation& method, std::uint64_t seed) {
  LatticePoints lattice = snapToLattice(pane.points);
  const std::vector<std::uint32_t> hull = hullCorners(lattice), border = distinctBorder(lattice, pane.border);
  if (hull.size() < 3 || border.size() < 3)
    throw InputError("triangulation: the border lies on one line, must enclose an area");
  const bool convex = twiceArea(lattice.nodes, border) == twiceArea(lattice.nodes, hull);
  std::vector<Triangle> triangles =
      convex ? std::visit(Run{lattice, hull, seed}, method) : std::visit(RunWithin{lattice, border, seed}, method);
  return {std::move(lattice.points), std::move(triangles)};
}

}  // namespace brisance
