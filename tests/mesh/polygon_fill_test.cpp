#include "mesh/polygon_fill.h"

#include <gtest/gtest.h>

#include <map>

#include "base/random.h"

namespace brisance {
namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

double areaOf(const std::vector<Vec2d>& points, const Triangle& t) {
  const Vec2d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}
double areaOf(const std::vector<Vec2d>& points, const std::vector<std::uint32_t>& loop) {
  double sum = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Vec2d &a = points[loop[n]], &b = points[loop[(n + 1) % loop.size()]];
    sum += (a.x * b.y - a.y * b.x) / 2;
  }
  return sum;
}

/// Sides of loops once, in their sense; all others in pairs.
void expectBorder(const Loops& loops, const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      ++sides[{t[k], t[(k + 1) % 3]}];
      --sides[{t[(k + 1) % 3], t[k]}];
    }
  for (const auto& loop : loops)
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const std::uint32_t a = loop[n], b = loop[(n + 1) % loop.size()];
      --sides[{a, b}];
      ++sides[{b, a}];
    }
  for (const auto& [side, times] : sides) EXPECT_EQ(times, 0) << side.first << " - " << side.second;
}

void expectFilled(const std::vector<Vec2d>& points, const Loops& loops) {
  const std::vector<Triangle> triangles = fillPolygon(points, loops);
  expectBorder(loops, triangles);
  double want = 0, sum = 0, size = 0;
  for (const auto& loop : loops) want += areaOf(points, loop);
  for (const Triangle& t : triangles) {
    sum += areaOf(points, t);
    size += std::abs(areaOf(points, t));
  }
  EXPECT_NEAR(sum, want, 1e-12 * std::abs(want));
  EXPECT_NEAR(size, want, 1e-12 * std::abs(want)) << "no triangle lies on another";
}

/// A star with `count` corners about a middle; clockwise if turned.
std::vector<std::uint32_t> addStar(std::vector<Vec2d>& points, const Vec2d& middle, double size, int count, bool turned,
                                   std::uint64_t seed) {
  const Random random(seed, Stream::test);
  std::vector<std::uint32_t> loop;
  for (int n = 0; n < count; ++n) {
    const auto [s, c] = portableSinCos(2 * pi * n / count);
    const double r = size * (0.4 + 0.6 * random.uniform(n));
    loop.push_back(static_cast<std::uint32_t>(points.size()));
    points.push_back({middle.x + r * c, middle.y + r * s});
  }
  if (turned) std::reverse(loop.begin(), loop.end());
  return loop;
}

TEST(PolygonFill, StarsWithHolesAreCoveredOnce) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Vec2d> points;
    Loops loops{addStar(points, {0, 0}, 10, 5 + static_cast<int>(seed) * 7, false, seed)};
    const Random random(seed, Stream::test);
    for (int hole = 0; hole < 6; ++hole) {
      const auto [s, c] = portableSinCos(2 * pi * (hole + random.uniform(1000 + hole) * 0.3) / 6);
      loops.push_back(addStar(points, {2 * c, 2 * s}, 0.7, 3 + hole * 5, true, seed + 100 * hole));
    }
    loops.push_back(addStar(points, {30, 1}, 5, 20, false, seed + 7));  // another island
    loops.push_back(addStar(points, {30, 1}, 1.5, 9, true, seed + 8));
    expectFilled(points, loops);
  }
}

TEST(PolygonFill, PointsAlongStraightSidesGiveNoFlatTriangles) {
  std::vector<Vec2d> points;
  std::vector<std::uint32_t> loop;
  const auto add = [&](double x, double y) {
    loop.push_back(static_cast<std::uint32_t>(points.size()));
    points.push_back({x, y});
  };
  constexpr int n = 50;
  for (int k = 0; k < n; ++k) add(k, 0);
  for (int k = 0; k < n; ++k) add(n, k);
  for (int k = 0; k < n; ++k) add(n - k, n);
  for (int k = 0; k < n; ++k) add(0, n - k);
  expectFilled(points, {loop});
  for (const Triangle& t : fillPolygon(points, {loop})) EXPECT_GT(areaOf(points, t), 0.1);
}

TEST(PolygonFill, LoopsThatCrossStillHaveTheirBorder) {
  const std::vector<Vec2d> points{{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0.5, 2}, {0, 0}, {0, 0}};
  for (const Loops& loops : {Loops{{0, 1, 2, 3, 4}}, Loops{{4, 3, 2, 1, 0}}, Loops{{0, 5, 6, 1}}})
    expectBorder(loops, fillPolygon(points, loops));
}

TEST(PolygonFill, ManyCornersTakeNoLongerThanTheyMust) {
  std::vector<Vec2d> points;
  const Loops loops{addStar(points, {0, 0}, 1, 30000, false, 3)};
  expectFilled(points, loops);
}

}  // namespace
}  // namespace brisance
