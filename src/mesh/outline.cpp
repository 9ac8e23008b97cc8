#include "mesh/outline.h"

#include <fmt/format.h>

#include <limits>

namespace brisance {
namespace {

// Parts of an outline nearer to one another than this share of its extent are not told apart safely: the lattice of
// triangulations is 500 times finer.
constexpr double leastGap = 1e-6;

double dot(const Vec2d& a, const Vec2d& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

double distanceToSegment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const Vec2d ab = b - a, ap = p - a;
  const double squared = dot(ab, ab), along = squared > 0 ? std::clamp(dot(ap, ab) / squared, 0.0, 1.0) : 0;
  const Vec2d gap = ap - ab * along;
  return std::sqrt(dot(gap, gap));
}

/// Edge i goes from corner i to the next; its x extent orders the search for neighbours.
struct Edge {
  std::size_t index;
  Vec2d a, b;
  double left() const { return std::min(a.x, b.x); }
  double right() const { return std::max(a.x, b.x); }
};

bool cross(const Edge& e, const Edge& f) {
  const auto opposite = [](double s, double t) { return (s > 0) != (t > 0); };
  return opposite(cross(e.b - e.a, f.a - e.a), cross(e.b - e.a, f.b - e.a)) &&
         opposite(cross(f.b - f.a, e.a - f.a), cross(f.b - f.a, e.b - f.a));
}

/// Whether two edges meet where they should not: neighbours may share their corner, and nothing else.
bool touch(const Edge& e, const Edge& f, std::size_t count, double gap) {
  if ((e.index + 1) % count == f.index)
    return distanceToSegment(f.b, e.a, e.b) < gap || distanceToSegment(e.a, f.a, f.b) < gap;
  if ((f.index + 1) % count == e.index) return touch(f, e, count, gap);
  if (cross(e, f)) return true;
  return std::min({distanceToSegment(e.a, f.a, f.b), distanceToSegment(e.b, f.a, f.b), distanceToSegment(f.a, e.a, e.b),
                   distanceToSegment(f.b, e.a, e.b)}) < gap;
}

std::string edgeName(std::size_t index, std::size_t count) {
  return fmt::format("{}-{}", index + 1, (index + 1) % count + 1);
}

/// Every pair of edges whose x extents overlap.
std::string touchingEdges(const std::vector<Vec2d>& corners, double gap) {
  const std::size_t n = corners.size();
  std::vector<Edge> edges;
  edges.reserve(n);
  for (std::size_t i = 0; i < n; ++i) edges.push_back({i, corners[i], corners[(i + 1) % n]});
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.left() < f.left(); });
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n && edges[j].left() <= edges[i].right() + gap; ++j)
      if (touch(edges[i], edges[j], n, gap)) {
        const auto [first, second] = std::minmax(edges[i].index, edges[j].index);
        return fmt::format("must not cross or touch itself, its edges {} and {} do (corners count from 1)",
                           edgeName(first, n), edgeName(second, n));
      }
  return "";
}

std::string polygonFault(const std::vector<Vec2d>& corners) {
  if (corners.size() < 3) return fmt::format("must have at least 3 corners, got {}", corners.size());
  for (const Vec2d& c : corners)
    if (!std::isfinite(c.x) || !std::isfinite(c.y)) return "must have finite corners";
  const Vec3d size = polygonBounds(corners).size();
  const double extent = std::max(size.x, size.y);
  if (std::min(size.x, size.y) <= leastGap * extent) return "must enclose an area, its corners lie on one line";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d side = corners[(i + 1) % corners.size()] - corners[i];
    if (std::max(std::abs(side.x), std::abs(side.y)) <= leastGap * extent)
      return fmt::format("must have no edge shorter than a millionth of its extent, edge {} is (corners count from 1)",
                         edgeName(i, corners.size()));
  }
  return touchingEdges(corners, leastGap * extent);
}

struct Fault {
  std::string operator()(const RectangleOutline& r) const {
    return r.width > 0 && r.height > 0 ? "" : "width and height must be above 0";
  }
  std::string operator()(const DiscOutline& d) const { return d.radius > 0 ? "" : "radius must be above 0"; }
  std::string operator()(const PolygonOutline& p) const { return polygonFault(p.corners); }
};

struct Corners {
  double spacing;
  std::vector<Vec2d> operator()(const RectangleOutline& r) const {
    const double x = r.width / 2, y = r.height / 2;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  }
  std::vector<Vec2d> operator()(const DiscOutline& disc) const {
    constexpr int fewestCorners = 96;  // the rim looks round: it is 0.05 % of the radius off the circle
    const double around = 2 * pi * disc.radius / spacing;
    const int count = around > fewestCorners ? static_cast<int>(std::lround(around)) : fewestCorners;
    std::vector<Vec2d> corners;
    for (int i = 0; i < count; ++i) {
      const SinCos turn = portableSinCos(2 * pi * i / count);
      corners.push_back({disc.radius * turn.cos, disc.radius * turn.sin});
    }
    return corners;
  }
  std::vector<Vec2d> operator()(const PolygonOutline& polygon) const {
    std::vector<Vec2d> corners = polygon.corners;
    if (polygonArea(corners) < 0) std::reverse(corners.begin(), corners.end());
    return corners;
  }
};

}  // namespace

std::string outlineFault(const Outline& outline) { return std::visit(Fault{}, outline); }

std::vector<Vec2d> outlineCorners(const Outline& outline, double spacing) {
  return std::visit(Corners{spacing}, outline);
}

double polygonArea(const std::vector<Vec2d>& corners) {
  double sum = 0;  // of triangles over the first corner
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum / 2;
}

Box3 polygonBounds(const std::vector<Vec2d>& corners) {
  Box3 box;
  for (const Vec2d& c : corners) box.include({c.x, c.y, 0});
  return box;
}

double distanceToBorder(const std::vector<Vec2d>& corners, const Vec2d& from, const Vec2d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d a = corners[i] - from, b = corners[(i + 1) % corners.size()] - from;
    const double sideA = cross(direction, a), sideB = cross(direction, b);
    if ((sideA > 0) == (sideB > 0)) continue;
    const Vec2d hit = a + (b - a) * (sideA / (sideA - sideB));
    const double distance = dot(hit, direction) / dot(direction, direction);
    if (distance > 0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

PolygonInside::PolygonInside(std::vector<Vec2d> corners, double margin)
    : corners_(std::move(corners)), margin_(margin), strips_(corners_.size()) {
  const Box3 box = polygonBounds(corners_);
  lower_ = box.lower.y;
  height_ = box.size().y;
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    const auto [low, high] = std::minmax(corners_[i].y, corners_[(i + 1) % corners_.size()].y);
    for (std::size_t s = stripOf(low - margin_); s <= stripOf(high + margin_); ++s) strips_[s].push_back(i);
  }
}

std::size_t PolygonInside::stripOf(double y) const {
  const double strip = (y - lower_) / height_ * static_cast<double>(strips_.size());
  return static_cast<std::size_t>(std::clamp(strip, 0.0, static_cast<double>(strips_.size() - 1)));
}

bool PolygonInside::contains(const Vec2d& p) const {
  bool inside = false;
  for (const std::uint32_t i : strips_[stripOf(p.y)]) {
    const Vec2d &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
    if (distanceToSegment(p, a, b) < margin_) return false;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) inside = !inside;
  }
  return inside;
}

}  // namespace brisance
