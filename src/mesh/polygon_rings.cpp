#include "mesh/polygon_rings.h"

#include <limits>

#include "mesh/ear_clipping.h"

namespace brisance {
namespace {

constexpr std::uint32_t noCorner = 0xFFFFFFFFu;

class RingMaker {
 public:
  explicit RingMaker(const std::vector<Vec2d>& points) : points_(points) {}

  PolygonRings make(const std::vector<std::vector<std::uint32_t>>& loops) {
    std::vector<std::uint32_t> holes;
    for (const auto& loop : loops) {
      const std::uint32_t start = addLoop(loop);
      if (area(loop) > 0)
        rings_.starts.push_back(start);
      else
        holes.push_back(leftmost(start));
    }
    std::sort(holes.begin(), holes.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Vec2d &p = at(a), &q = at(b);
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
    });
    // Loops without an outer one are no polygon, but are filled all the same.
    if (rings_.starts.empty()) {
      rings_.starts = holes;
      return std::move(rings_);
    }
    for (const std::uint32_t hole : holes) bridge(hole);
    return std::move(rings_);
  }

 private:
  const Vec2d& at(std::uint32_t corner) const { return points_[rings_.corners[corner].point]; }

  double area(const std::vector<std::uint32_t>& loop) const {
    double sum = 0;
    for (std::size_t n = 1; n + 1 < loop.size(); ++n)
      sum += turn(points_[loop[0]], points_[loop[n]], points_[loop[n + 1]]);
    return sum;
  }

  std::uint32_t addLoop(const std::vector<std::uint32_t>& loop) {
    const auto start = static_cast<std::uint32_t>(rings_.corners.size()),
               count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t n = 0; n < count; ++n)
      rings_.corners.push_back({loop[n], start + (n + count - 1) % count, start + (n + 1) % count});
    return start;
  }

  std::uint32_t leftmost(std::uint32_t start) const {
    std::uint32_t best = start;
    for (std::uint32_t c = rings_.corners[start].after; c != start; c = rings_.corners[c].after)
      if (at(c).x < at(best).x || (at(c).x == at(best).x && at(c).y < at(best).y)) best = c;
    return best;
  }

  /// Calls visit(corner) for all corners of outer rings and of holes joined to them.
  template <class Visit>
  void forEachJoined(const Visit& visit) const {
    for (const std::uint32_t start : rings_.starts) {
      std::uint32_t c = start;
      do {
        visit(c);
        c = rings_.corners[c].after;
      } while (c != start);
    }
  }

  /// The nearest side to the left of a corner, and where the ray meets it.
  std::uint32_t sideToTheLeft(std::uint32_t hole, double& x) const {
    const Vec2d& p = at(hole);
    std::uint32_t nearest = noCorner;
    x = -std::numeric_limits<double>::infinity();
    forEachJoined([&](std::uint32_t c) {
      const Vec2d &a = at(c), &b = at(rings_.corners[c].after);
      // The polygon lies to the left of its sides, which is to the right of one that goes down.
      if (!(a.y >= p.y && b.y <= p.y && a.y > b.y)) return;
      const double meets = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
      if (meets > p.x || meets <= x) return;
      x = meets;
      nearest = c;
    });
    return nearest;
  }

  /// The side's end further left may be hidden by corners between it and the ray: the one of least slope sees the hole.
  std::uint32_t visibleCorner(std::uint32_t hole, std::uint32_t side, double x) const {
    const Vec2d &p = at(hole), meets{x, p.y};
    const std::uint32_t end = rings_.corners[side].after;
    std::uint32_t best = at(side).x < at(end).x ? side : end;
    const Vec2d corner = at(best);
    double leastSlope = std::numeric_limits<double>::infinity();
    forEachJoined([&](std::uint32_t c) {
      const Vec2d& q = at(c);
      if (q.x > p.x || q.x < corner.x || !insideEither(p, meets, corner, q)) return;
      const double slope = q.x < p.x ? std::abs(q.y - p.y) / (p.x - q.x) : std::numeric_limits<double>::infinity();
      if (slope >= leastSlope || !opensTowards(c, p)) return;
      leastSlope = slope;
      best = c;
    });
    return best;
  }
  static bool insideEither(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& q) {
    const double u = turn(a, b, q), v = turn(b, c, q), w = turn(c, a, q);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }
  /// Whether a line from the corner to p begins inside the polygon.
  bool opensTowards(std::uint32_t corner, const Vec2d& p) const {
    const Vec2d &a = at(rings_.corners[corner].before), &b = at(corner), &c = at(rings_.corners[corner].after);
    const bool leftOfFirst = turn(a, b, p) > 0, leftOfSecond = turn(b, c, p) > 0;
    return turn(a, b, c) > 0 ? leftOfFirst && leftOfSecond : leftOfFirst || leftOfSecond;
  }

  void bridge(std::uint32_t hole) {
    double x = 0;
    const std::uint32_t side = sideToTheLeft(hole, x);
    join(side == noCorner ? rings_.starts.front() : visibleCorner(hole, side, x), hole);
  }

  /// ring .. a, hole's loop from h round to h again, a again ..
  void join(std::uint32_t a, std::uint32_t h) {
    auto& corners = rings_.corners;
    const auto secondA = static_cast<std::uint32_t>(corners.size()), secondH = secondA + 1;
    corners.push_back({corners[a].point, secondH, corners[a].after});
    corners.push_back({corners[h].point, corners[h].before, secondA});
    corners[corners[a].after].before = secondA;
    corners[corners[h].before].after = secondH;
    corners[a].after = h;
    corners[h].before = a;
  }

  const std::vector<Vec2d>& points_;
  PolygonRings rings_;
};

}  // namespace

PolygonRings polygonRings(const std::vector<Vec2d>& points, const std::vector<std::vector<std::uint32_t>>& loops) {
  return RingMaker(points).make(loops);
}

}  // namespace brisance
