#include "base/check.h"
#include "mesh/triangle_net.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

/// Splits triangles at random points of theirs until every point is a corner. A point on an edge waits in either of the
/// edge's triangles, and halves both.
class Trisector {
 public:
  Trisector(const LatticePoints& points, std::vector<Triangle> start, std::uint64_t seed)
      : nodes_(points.nodes),
        net_(std::move(start), points.nodes.size()),
        waiting_(net_.triangles().size()),
        random_(seed, Stream::trisection) {}

  /// Puts a point into the first triangle of the start that holds it.
  void add(std::uint32_t point) {
    for (std::uint32_t t = 0; t < waiting_.size(); ++t)
      if (holds(t, point)) return waiting_[t].push_back(point);
    CHECK(false, "point {} lies in no triangle of the hull", point);
  }

  std::vector<Triangle> split() {
    for (std::uint32_t t = 0; t < net_.triangles().size(); ++t)
      while (!waiting_[t].empty()) splitAt(t, takeAny(t));
    return net_.triangles();
  }

 private:
  std::int64_t side(std::uint32_t triangle, int edge, std::uint32_t point) const {
    const Triangle& t = net_.triangles()[triangle];
    return orientation(nodes_[t[edge]], nodes_[t[(edge + 1) % 3]], nodes_[point]);
  }
  bool holds(std::uint32_t triangle, std::uint32_t point) const {
    return side(triangle, 0, point) >= 0 && side(triangle, 1, point) >= 0 && side(triangle, 2, point) >= 0;
  }

  std::uint32_t takeAny(std::uint32_t triangle) {
    std::vector<std::uint32_t>& points = waiting_[triangle];
    std::swap(points[random_.below(points.size(), draw_++)], points.back());
    const std::uint32_t point = points.back();
    points.pop_back();
    return point;
  }

  void splitAt(std::uint32_t triangle, std::uint32_t point) {
    const auto firstNew = static_cast<std::uint32_t>(net_.triangles().size());
    for (int edge = 0; edge < 3; ++edge) {
      if (side(triangle, edge, point) != 0) continue;
      const std::uint32_t other = net_.neighbours()[triangle][edge];
      net_.splitEdge(triangle, edge, point);
      waiting_.resize(net_.triangles().size());
      share(triangle, {triangle, firstNew});
      if (other != noTriangle) share(other, {other, firstNew + 1});
      return;
    }
    net_.splitInside(triangle, point);
    waiting_.resize(net_.triangles().size());
    share(triangle, {triangle, firstNew, firstNew + 1});
  }

  /// The points of what was one triangle go to the parts that hold them.
  void share(std::uint32_t whole, const std::vector<std::uint32_t>& parts) {
    const std::vector<std::uint32_t> points = std::move(waiting_[whole]);
    waiting_[whole].clear();
    for (const std::uint32_t point : points) {
      const auto part = std::find_if(parts.begin(), parts.end(), [&](std::uint32_t t) { return holds(t, point); });
      CHECK(part != parts.end(), "point {} was lost in a split", point);
      waiting_[*part].push_back(point);
    }
  }

  const std::vector<LatticePoint>& nodes_;
  TriangleNet net_;
  std::vector<std::vector<std::uint32_t>> waiting_;  ///< points in each triangle that are no corner yet
  Random random_;
  std::uint64_t draw_ = 0;
};

bool strictlyInside(const LatticePoints& points, const std::vector<std::uint32_t>& hull, std::uint32_t point) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (orientation(points.nodes[hull[i]], points.nodes[hull[(i + 1) % hull.size()]], points.nodes[point]) <= 0)
      return false;
  return true;
}

/// All edges of the hull seen from `apex`, which may be one of its corners.
std::vector<Triangle> fan(const std::vector<std::uint32_t>& hull, std::uint32_t apex) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::uint32_t a = hull[i], b = hull[(i + 1) % hull.size()];
    if (a != apex && b != apex) triangles.push_back({apex, a, b});
  }
  return triangles;
}

/// A random point inside the hull divides it; a corner where no point is inside.
std::uint32_t chooseApex(const LatticePoints& points, const std::vector<std::uint32_t>& hull, const Random& random) {
  std::vector<std::uint32_t> inside;
  for (const std::uint32_t point : points.distinct)
    if (strictlyInside(points, hull, point)) inside.push_back(point);
  return inside.empty() ? hull[0] : inside[random.below(inside.size(), ~std::uint64_t{0})];
}

}  // namespace

std::vector<Triangle> trisect(const LatticePoints& points, std::uint64_t seed) {
  const std::vector<std::uint32_t> hull = hullCorners(points);
  const std::uint32_t apex = chooseApex(points, hull, Random(seed, Stream::trisection));
  std::vector<bool> isCorner(points.nodes.size(), false);
  for (const std::uint32_t corner : hull) isCorner[corner] = true;
  isCorner[apex] = true;
  Trisector trisector(points, fan(hull, apex), seed);
  for (const std::uint32_t point : points.distinct)
    if (!isCorner[point]) trisector.add(point);
  return trisector.split();
}

}  // namespace brisance
