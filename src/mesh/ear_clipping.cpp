#include "mesh/ear_clipping.h"

#include "base/check.h"
#include "mesh/polygon_rings.h"

namespace brisance {
namespace {

/// Corners in square bins: which of them may lie inside a triangle.
class CornerBins {
 public:
  CornerBins(const std::vector<Vec2d>& places, const std::vector<std::uint32_t>& corners) {
    lower_ = {1e300, 1e300};
    Vec2d upper{-1e300, -1e300};
    for (const Vec2d& p : places) {
      lower_ = {std::min(lower_.x, p.x), std::min(lower_.y, p.y)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
    }
    const double extent = std::max(upper.x - lower_.x, upper.y - lower_.y);
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(corners.size()))), 1, 512);
    scale_ = extent > 0 ? side_ / extent : 0;
    first_.assign(static_cast<std::size_t>(side_) * side_ + 1, 0);
    for (const Vec2d& p : places) ++first_[bin(p) + 1];
    for (std::size_t b = 0; b + 1 < first_.size(); ++b) first_[b + 1] += first_[b];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    corners_.resize(corners.size());
    for (std::size_t n = 0; n < corners.size(); ++n) corners_[next[bin(places[n])]++] = corners[n];
  }

  /// Whether `test(corner)` holds for one in the bins that the triangle's box touches.
  template <class Test>
  bool anyNear(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Test& test) const {
    const int x0 = index(std::min({a.x, b.x, c.x}) - lower_.x), x1 = index(std::max({a.x, b.x, c.x}) - lower_.x);
    const int y0 = index(std::min({a.y, b.y, c.y}) - lower_.y), y1 = index(std::max({a.y, b.y, c.y}) - lower_.y);
    for (int y = y0; y <= y1; ++y)
      for (std::uint32_t n = first_[y * side_ + x0]; n < first_[y * side_ + x1 + 1]; ++n)
        if (test(corners_[n])) return true;
    return false;
  }

 private:
  int index(double offset) const { return std::clamp(static_cast<int>(offset * scale_), 0, side_ - 1); }
  std::size_t bin(const Vec2d& p) const {
    return static_cast<std::size_t>(index(p.y - lower_.y)) * side_ + index(p.x - lower_.x);
  }

  Vec2d lower_;
  int side_;
  double scale_;
  std::vector<std::uint32_t> first_, corners_;
};

class EarClipper {
 public:
  EarClipper(const std::vector<Vec2d>& points, PolygonRings rings)
      : points_(points), corners_(std::move(rings.corners)), alive_(corners_.size(), true) {
    for (const std::uint32_t start : rings.starts) clipRing(start);
  }
  std::vector<Triangle> triangles;

 private:
  const Vec2d& at(std::uint32_t corner) const { return points_[corners_[corner].point]; }
  double turnAt(std::uint32_t corner) const {
    return turn(at(corners_[corner].before), at(corner), at(corners_[corner].after));
  }

  /// Only corners that do not bend outwards can lie inside an ear.
  CornerBins hollows(std::uint32_t start, std::size_t& left) const {
    std::vector<std::uint32_t> hollow;
    std::vector<Vec2d> places;
    left = 0;
    std::uint32_t c = start;
    do {
      ++left;
      if (turnAt(c) <= 0) {
        hollow.push_back(c);
        places.push_back(at(c));
      }
      c = corners_[c].after;
    } while (c != start);
    return {places, hollow};
  }

  bool isEar(std::uint32_t corner, const CornerBins& bins) const {
    const std::uint32_t before = corners_[corner].before, after = corners_[corner].after;
    const Vec2d &a = at(before), &b = at(corner), &c = at(after);
    if (turn(a, b, c) <= 0) return false;
    return !bins.anyNear(a, b, c, [&](std::uint32_t other) {
      if (!alive_[other]) return false;
      const Vec2d& p = at(other);
      // A bridge's two ends share their points, and do not lie inside one another's ears.
      if (p == a || p == b || p == c) return false;
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  void clip(std::uint32_t corner) {
    const auto [point, before, after] = corners_[corner];
    triangles.push_back({corners_[before].point, point, corners_[after].point});
    corners_[before].after = after;
    corners_[after].before = before;
    alive_[corner] = false;
  }

  void clipRing(std::uint32_t start) {
    std::size_t left = 0;
    const CornerBins bins = hollows(start, left);
    std::uint32_t corner = start;
    for (std::size_t tried = 0; left > 3;) {
      const bool ear = isEar(corner, bins);
      if (!ear && ++tried <= left) {
        corner = corners_[corner].after;
        continue;
      }
      if (!ear) corner = widest(corner);
      const std::uint32_t after = corners_[corner].after;
      clip(corner);
      --left;
      tried = 0;
      corner = corners_[after].after;  // not beside the last ear: fans of slivers are avoided
    }
    if (left == 3) clip(corner);
  }

  /// Where rounding leaves no ear: the corner that bends outwards most.
  std::uint32_t widest(std::uint32_t start) const {
    std::uint32_t best = start;
    for (std::uint32_t c = corners_[start].after; c != start; c = corners_[c].after)
      if (turnAt(c) > turnAt(best)) best = c;
    return best;
  }

  const std::vector<Vec2d>& points_;
  std::vector<RingCorner> corners_;
  std::vector<bool> alive_;
};

}  // namespace

std::vector<Triangle> clipEars(const std::vector<Vec2d>& points, const std::vector<std::vector<std::uint32_t>>& loops) {
  for (const auto& loop : loops) CHECK(loop.size() >= 3, "a loop of {} corners", loop.size());
  return EarClipper(points, polygonRings(points, loops)).triangles;
}

}  // namespace brisance
