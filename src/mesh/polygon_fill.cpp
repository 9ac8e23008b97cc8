#include "mesh/polygon_fill.h"

#include "base/check.h"
#include "mesh/ear_clipping.h"
#include "mesh/triangle_net.h"

namespace brisance {
namespace {

/// Roundness of a triangle: area over the sum of its squared sides, below zero where it is turned over.
double roundness(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const auto square = [](const Vec2d& p) { return p.x * p.x + p.y * p.y; };
  const double sides = square(b - a) + square(c - b) + square(a - c);
  return sides > 0 ? turn(a, b, c) / sides : 0;
}

/// Exchanges diagonals while the flatter of two neighbours becomes rounder. Each exchange raises the sorted list of
/// all roundnesses, so there is an end.
class Rounder {
 public:
  Rounder(const std::vector<Vec2d>& points, std::vector<Triangle> triangles)
      : points_(points), net_(std::move(triangles), points.size()) {}

  std::vector<Triangle> run() {
    for (std::uint32_t t = 0; t < net_.triangles().size(); ++t) open_.push_back(t);
    while (!open_.empty()) {
      const std::uint32_t t = open_.back();
      open_.pop_back();
      for (int edge = 0; edge < 3; ++edge)
        if (flipped(t, edge)) break;
    }
    return net_.triangles();
  }

 private:
  bool flipped(std::uint32_t t, int edge) {
    const std::uint32_t other = net_.neighbours()[t][edge];
    if (other == noTriangle || other == t) return false;
    const Triangle &here = net_.triangles()[t], &there = net_.triangles()[other];
    const int back = net_.edgeTo(other, t);
    const std::uint32_t a = here[edge], b = here[(edge + 1) % 3], c = here[(edge + 2) % 3], d = there[(back + 2) % 3];
    if (there[back] != b || there[(back + 1) % 3] != a || c == d) return false;
    const Vec2d &pa = points_[a], &pb = points_[b], &pc = points_[c], &pd = points_[d];
    const double before = std::min(roundness(pa, pb, pc), roundness(pb, pa, pd));
    const double after = std::min(roundness(pa, pd, pc), roundness(pd, pb, pc));
    constexpr double leastGain = 1e-9;  // of the greatest roundness: rounding must not flip for ever
    if (after <= before + leastGain) return false;
    net_.flip(t, edge);
    open_.push_back(t);
    open_.push_back(other);
    return true;
  }

  const std::vector<Vec2d>& points_;
  TriangleNet net_;
  std::vector<std::uint32_t> open_;
};

}  // namespace

std::vector<Triangle> fillPolygon(const std::vector<Vec2d>& points,
                                  const std::vector<std::vector<std::uint32_t>>& loops) {
  return Rounder(points, clipEars(points, loops)).run();
}

}  // namespace brisance
