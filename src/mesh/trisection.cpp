#include "base/random.h"
#include "mesh/triangle_net.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

/// Splits triangles at random points of theirs until every point is a corner. A point on an edge waits in either of the
/// edge's triangles, and halves both. The points that wait in one triangle lie side by side in one list.
class Trisector {
 public:
  Trisector(const LatticePoints& points, std::vector<Triangle> start, std::uint64_t seed)
      : nodes_(points.nodes),
        net_(std::move(start), points.nodes.size()),
        startOf_(net_.triangles().size()),
        random_(seed, Stream::trisection) {}

  /// Puts a point into the first triangle of the start that holds it, if any does.
  void add(std::uint32_t point) {
    for (std::uint32_t t = 0; t < startOf_.size(); ++t)
      if (holds(t, point)) return startOf_[t].push_back(point);
  }

  std::vector<Triangle> split() {
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& points : startOf_) count += points.size();
    waiting_.reserve(count);
    for (const std::vector<std::uint32_t>& points : startOf_) {
      const auto first = static_cast<std::uint32_t>(waiting_.size());
      for (const std::uint32_t point : points) waiting_.push_back({nodes_[point], point});
      ranges_.push_back({first, static_cast<std::uint32_t>(waiting_.size())});
    }
    net_.reserve(ranges_.size() + 2 * waiting_.size());
    ranges_.reserve(ranges_.size() + 2 * waiting_.size());
    for (std::uint32_t t = 0; t < net_.triangles().size(); ++t)
      while (ranges_[t].first != ranges_[t].last) splitAt(t, takeAny(t));
    return net_.release();
  }

 private:
  struct Waiting {
    LatticePoint place;
    std::uint32_t point;
  };
  /// Places in waiting_ from first to before last.
  struct Range {
    std::uint32_t first = 0, last = 0;
  };

  std::int64_t side(std::uint32_t triangle, int edge, std::uint32_t point) const {
    const Triangle& t = net_.triangles()[triangle];
    return orientation(nodes_[t[edge]], nodes_[t[(edge + 1) % 3]], nodes_[point]);
  }
  bool holds(std::uint32_t triangle, std::uint32_t point) const {
    return side(triangle, 0, point) >= 0 && side(triangle, 1, point) >= 0 && side(triangle, 2, point) >= 0;
  }

  std::uint32_t takeAny(std::uint32_t triangle) {
    Range& range = ranges_[triangle];
    --range.last;
    std::swap(waiting_[range.first + random_.below(range.last - range.first + 1, draw_++)], waiting_[range.last]);
    return waiting_[range.last].point;
  }

  void splitAt(std::uint32_t triangle, std::uint32_t point) {
    const auto firstNew = static_cast<std::uint32_t>(net_.triangles().size());
    for (int edge = 0; edge < 3; ++edge) {
      if (side(triangle, edge, point) != 0) continue;
      const std::uint32_t other = net_.neighbours()[triangle][edge];
      net_.splitEdge(triangle, edge, point);
      ranges_.resize(net_.triangles().size());
      share(triangle, firstNew, firstNew, point);
      if (other != noTriangle) share(other, firstNew + 1, firstNew + 1, point);
      return;
    }
    net_.splitInside(triangle, point);
    ranges_.resize(net_.triangles().size());
    share(triangle, firstNew, firstNew + 1, point);
  }

  /// The points of what was one triangle go to the parts that hold them, in their old order: to `triangle` itself, and
  /// to the new ones from `second` to `third` around their common corner `tip`. (Both new names may be one.)
  void share(std::uint32_t triangle, std::uint32_t second, std::uint32_t third, std::uint32_t tip) {
    const Range whole = ranges_[triangle];
    const Wedge kept = wedgeOf(triangle, tip), moved = wedgeOf(second, tip);
    std::uint32_t end = whole.first;
    moved_[0].clear();
    moved_[1].clear();
    for (std::uint32_t i = whole.first; i < whole.last; ++i) {
      const Waiting point = waiting_[i];
      if (kept.holds(point.place))
        waiting_[end++] = point;
      else
        moved_[second == third || moved.holds(point.place) ? 0 : 1].push_back(point);
    }
    ranges_[triangle] = {whole.first, end};
    ranges_[second] = append(end, moved_[0]);
    if (second != third) ranges_[third] = append(ranges_[second].last, moved_[1]);
  }
  Range append(std::uint32_t place, const std::vector<Waiting>& points) {
    std::copy(points.begin(), points.end(), waiting_.begin() + place);
    return {place, place + static_cast<std::uint32_t>(points.size())};
  }

  /// What lies between two edges of a triangle.
  struct Wedge {
    LatticePoint tip, right, left;
    bool holds(const LatticePoint& p) const {
      return orientation(tip, right, p) >= 0 && orientation(left, tip, p) >= 0;
    }
  };
  Wedge wedgeOf(std::uint32_t triangle, std::uint32_t tip) const {
    const auto& [a, b, c] = net_.triangles()[triangle];
    if (a == tip) return {nodes_[a], nodes_[b], nodes_[c]};
    return b == tip ? Wedge{nodes_[b], nodes_[c], nodes_[a]} : Wedge{nodes_[c], nodes_[a], nodes_[b]};
  }

  const std::vector<LatticePoint>& nodes_;
  TriangleNet net_;
  std::vector<std::vector<std::uint32_t>> startOf_;  ///< points in each triangle of the start
  std::vector<Waiting> waiting_;                     ///< points that are no corner yet
  std::vector<Range> ranges_;                        ///< of each triangle in waiting_
  std::vector<Waiting> moved_[2];                    ///< scratch of share
  Random random_;
  std::uint64_t draw_ = 0;
};

/// Whether a point lies to the left of all edges of a polygon: it sees the polygon's whole border.
bool seesAll(const LatticePoints& points, const std::vector<std::uint32_t>& polygon, std::uint32_t point) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (orientation(points.nodes[polygon[i]], points.nodes[polygon[(i + 1) % polygon.size()]], points.nodes[point]) <=
        0)
      return false;
  return true;
}

/// All edges of a polygon seen from `apex`, which may be one of its corners.
std::vector<Triangle> fan(const std::vector<std::uint32_t>& polygon, std::uint32_t apex) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a != apex && b != apex) triangles.push_back({apex, a, b});
  }
  return triangles;
}

/// The border alone, as if there were no points inside.
std::vector<Triangle> triangulatedBorder(const LatticePoints& points, const std::vector<std::uint32_t>& border) {
  LatticePoints alone{points.nodes, {}, border};
  std::sort(alone.distinct.begin(), alone.distinct.end(),
            [&](std::uint32_t a, std::uint32_t b) { return points.nodes[a] < points.nodes[b]; });
  return withinBorder(delaunay(alone), points.nodes, border);
}

std::vector<Triangle> startOf(const LatticePoints& points, const std::vector<std::uint32_t>& border,
                              std::uint64_t seed) {
  std::vector<std::uint32_t> inside;
  for (const std::uint32_t point : points.distinct)
    if (seesAll(points, border, point)) inside.push_back(point);
  if (!inside.empty())
    return fan(border, inside[Random(seed, Stream::trisection).below(inside.size(), ~std::uint64_t{0})]);
  return border == hullCorners(points) ? fan(border, border[0]) : triangulatedBorder(points, border);
}

}  // namespace

std::vector<Triangle> trisect(const LatticePoints& points, const std::vector<std::uint32_t>& border,
                              std::uint64_t seed) {
  std::vector<Triangle> start = startOf(points, border, seed);
  std::vector<bool> isCorner(points.nodes.size(), false);
  for (const Triangle& t : start)
    for (const std::uint32_t corner : t) isCorner[corner] = true;
  Trisector trisector(points, std::move(start), seed);
  for (const std::uint32_t point : points.distinct)
    if (!isCorner[point]) trisector.add(point);
  return trisector.split();
}

}  // namespace brisance
