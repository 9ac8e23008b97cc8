// Divide and conquer (Guibas & Stolfi 1985), halves cut across x and y by turns (Dwyer 1987), on lattice points.
#include "base/check.h"
#include "base/parallel.h"
#include "mesh/edge_net.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

struct RankedPoint {
  LatticePoint place;
  std::uint32_t rank;  ///< place in the lexicographic order of all points
};

/// "Left" of one another: across x, or, the plane turned by a quarter, across y.
bool isLeft(const LatticePoint& a, const LatticePoint& b, int axis) {
  if (axis == 0) return a.x != b.x ? a.x < b.x : a.y < b.y;
  return a.y != b.y ? a.y < b.y : a.x > b.x;
}

/// A part of the points, [first, last).
struct Part {
  std::uint32_t first = 0, last = 0;
  std::uint32_t middle() const { return first + (last - first) / 2; }
  std::uint32_t size() const { return last - first; }
};

/// Side of the hull, with the outside to its right.
using HullSide = std::uint32_t;

class DivideAndConquer {
 public:
  explicit DivideAndConquer(const LatticePoints& points) : net_(edgesPerPoint * points.distinct.size()) {
    const auto count = static_cast<std::uint32_t>(points.distinct.size());
    points_.reserve(count);
    for (std::uint32_t rank = 0; rank < count; ++rank) points_.push_back({points.nodes[points.distinct[rank]], rank});
    places_.resize(count);
  }

  /// Parts are worked on by several threads, then merged in pairs.
  void run() {
    std::vector<Part> parts{{0, static_cast<std::uint32_t>(points_.size())}};
    int depth = 0;
    for (; parts[0].size() > smallestTask && depth < taskDepth; ++depth) parts = halves(parts, depth);
    std::vector<EdgePool> pools(parts.size());
    std::vector<HullSide> hulls(parts.size());
    forEach(parts.size(), [&](std::size_t i) {
      pools[i].unused = {{edgesPerPoint * parts[i].first, edgesPerPoint * parts[i].last}};
      hulls[i] = triangulate(parts[i], depth, pools[i]);
    });
    while (parts.size() > 1) {
      --depth;
      const std::size_t pairs = parts.size() / 2;
      forEach(pairs, [&](std::size_t i) {
        pools[2 * i].join(std::move(pools[2 * i + 1]));
        hulls[2 * i] = merge(hulls[2 * i], hulls[2 * i + 1], depth % 2, pools[2 * i]);
      });
      for (std::size_t i = 0; i < pairs; ++i) {
        parts[i] = {parts[2 * i].first, parts[2 * i + 1].last};
        std::swap(pools[i], pools[2 * i]);
        hulls[i] = hulls[2 * i];
      }
      parts.resize(pairs);
    }
  }

  std::vector<Triangle> triangles(const LatticePoints& points) const {
    constexpr std::uint32_t block = 1u << 16;
    const std::uint32_t sides = net_.sideCount(), blocks = (sides + block - 1) / block;
    std::vector<std::vector<Triangle>> found(blocks);
    forEach(blocks, [&](std::size_t b) {
      const auto first = static_cast<std::uint32_t>(b) * block;
      for (std::uint32_t side = first; side < std::min(sides, first + block); ++side) collect(side, points, found[b]);
    });
    std::vector<Triangle> all;
    all.reserve(2 * points_.size());
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

 private:
  static constexpr std::uint32_t edgesPerPoint = 3;  // n points have at most 3 n - 3 edges (Euler)
  static constexpr std::uint32_t smallestTask = 2000;
  static constexpr int taskDepth = 4;

  template <class Body>
  static void forEach(std::size_t count, const Body& body) {
    parallelFor(0, static_cast<std::int64_t>(count), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) body(static_cast<std::size_t>(i));
    });
  }

  /// Orders the points of a part so that those of its left half come first.
  void divide(const Part& part, int axis) {
    const auto at = [&](std::uint32_t i) { return points_.begin() + i; };
    std::nth_element(at(part.first), at(part.middle()), at(part.last),
                     [axis](const RankedPoint& a, const RankedPoint& b) { return isLeft(a.place, b.place, axis); });
  }
  std::vector<Part> halves(const std::vector<Part>& parts, int depth) {
    std::vector<Part> result(2 * parts.size());
    forEach(parts.size(), [&](std::size_t i) {
      divide(parts[i], depth % 2);
      result[2 * i] = {parts[i].first, parts[i].middle()};
      result[2 * i + 1] = {parts[i].middle(), parts[i].last};
    });
    return result;
  }

  HullSide triangulate(const Part& part, int depth, EdgePool& pool) {
    if (part.size() <= 3) return smallest(part, pool);
    divide(part, depth % 2);
    const HullSide left = triangulate({part.first, part.middle()}, depth + 1, pool);
    const HullSide right = triangulate({part.middle(), part.last}, depth + 1, pool);
    return merge(left, right, depth % 2, pool);
  }

  /// Two points or three, from left to right.
  HullSide smallest(const Part& part, EdgePool& pool) {
    std::sort(points_.begin() + part.first, points_.begin() + part.last,
              [](const RankedPoint& a, const RankedPoint& b) { return a.rank < b.rank; });
    for (std::uint32_t i = part.first; i < part.last; ++i) places_[i] = points_[i].place;
    const std::uint32_t p = part.first;
    const std::uint32_t a = net_.add(pool, p, p + 1);
    if (part.size() == 2) return a;
    const std::uint32_t b = net_.add(pool, p + 1, p + 2);
    net_.insertAfter(EdgeNet::twin(a), b);
    const std::int64_t turn = orientation(places_[p], places_[p + 1], places_[p + 2]);
    if (turn != 0) net_.connect(pool, b, a);
    return turn >= 0 ? a : EdgeNet::twin(a);
  }

  std::int64_t turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation(places_[a], places_[b], places_[c]);
  }
  bool inCircle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return insideCircleOrTie(places_[a], places_[b], places_[c], places_[d]);
  }

  /// The hull's side out of its leftmost point.
  HullSide outOfLeftmost(HullSide hull, int axis) const {
    HullSide best = hull;
    for (HullSide side = net_.rightOnward(hull); side != hull; side = net_.rightOnward(side))
      if (isLeft(places_[net_.origin(side)], places_[net_.origin(best)], axis)) best = side;
    return best;
  }
  /// The hull's side into its rightmost point.
  HullSide intoRightmost(HullSide hull, int axis) const {
    HullSide best = hull;
    for (HullSide side = net_.rightOnward(hull); side != hull; side = net_.rightOnward(side))
      if (isLeft(places_[net_.target(best)], places_[net_.target(side)], axis)) best = side;
    return best;
  }

  /// The edge from the right hull to the left one that has both above it.
  std::uint32_t lowerTangent(HullSide leftHull, HullSide rightHull, int axis, EdgePool& pool) {
    // Both walk downwards: counter-clockwise on the right hull, clockwise on the left.
    std::uint32_t left = EdgeNet::twin(intoRightmost(leftHull, axis));
    std::uint32_t right = outOfLeftmost(rightHull, axis);
    for (;;) {
      if (turn(net_.origin(right), net_.origin(left), net_.target(left)) > 0)
        left = net_.leftNext(left);
      else if (turn(net_.origin(left), net_.target(right), net_.origin(right)) > 0)
        right = net_.rightOnward(right);
      else
        return net_.connect(pool, EdgeNet::twin(right), left);
    }
  }

  /// Candidates rise from the base; one whose circle with the base holds the next point behind it is no edge.
  std::uint32_t leftCandidate(std::uint32_t base, EdgePool& pool) {
    std::uint32_t side = net_.next(EdgeNet::twin(base));
    if (!isAbove(base, side)) return side;
    while (inCircle(net_.target(base), net_.origin(base), net_.target(side), net_.target(net_.next(side)))) {
      const std::uint32_t behind = net_.next(side);
      net_.remove(pool, side);
      side = behind;
    }
    return side;
  }
  std::uint32_t rightCandidate(std::uint32_t base, EdgePool& pool) {
    std::uint32_t side = net_.previous(base);
    if (!isAbove(base, side)) return side;
    while (inCircle(net_.target(base), net_.origin(base), net_.target(side), net_.target(net_.previous(side)))) {
      const std::uint32_t behind = net_.previous(side);
      net_.remove(pool, side);
      side = behind;
    }
    return side;
  }
  bool isAbove(std::uint32_t base, std::uint32_t side) const {
    return turn(net_.target(side), net_.target(base), net_.origin(base)) > 0;
  }

  /// Joins two parts by edges from the lower tangent to the upper one; returns the former.
  HullSide merge(HullSide leftHull, HullSide rightHull, int axis, EdgePool& pool) {
    std::uint32_t base = lowerTangent(leftHull, rightHull, axis, pool);
    const HullSide lower = EdgeNet::twin(base);
    for (;;) {
      const std::uint32_t left = leftCandidate(base, pool), right = rightCandidate(base, pool);
      const bool leftRises = isAbove(base, left), rightRises = isAbove(base, right);
      if (!leftRises && !rightRises) return lower;
      const bool takeRight = !leftRises || (rightRises && inCircle(net_.target(left), net_.origin(left),
                                                                   net_.origin(right), net_.target(right)));
      base = takeRight ? net_.connect(pool, right, EdgeNet::twin(base))
                       : net_.connect(pool, EdgeNet::twin(base), EdgeNet::twin(left));
    }
  }

  /// The triangle to the left of a side, once: from its lexicographically least corner.
  void collect(std::uint32_t side, const LatticePoints& points, std::vector<Triangle>& triangles) const {
    if (!net_.exists(side)) return;
    const std::uint32_t second = net_.leftNext(side), third = net_.leftNext(second);
    const std::uint32_t a = net_.origin(side), b = net_.origin(second), c = net_.origin(third);
    const std::uint32_t rank = points_[a].rank;
    if (rank > points_[b].rank || rank > points_[c].rank || net_.leftNext(third) != side || turn(a, b, c) <= 0) return;
    triangles.push_back({points.distinct[rank], points.distinct[points_[b].rank], points.distinct[points_[c].rank]});
  }

  std::vector<RankedPoint> points_;
  std::vector<LatticePoint> places_;  ///< of points_, once their order stands
  EdgeNet net_;
};

}  // namespace

std::vector<Triangle> delaunay(const LatticePoints& points) {
  DivideAndConquer work(points);
  work.run();
  return work.triangles(points);
}

}  // namespace brisance
