#include "mesh/convex_hull.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

TEST(ConvexHull, OfABoxIsTheBox) {
  TriangleMesh box = boxMesh({1, 2, 3}, false);
  std::vector<Vec3d> points = box.vertices;
  const Random random(1, Stream::test);
  for (int n = 0; n < 200; ++n)
    points.push_back(
        {random.uniform(3 * n) - 0.5, 2 * random.uniform(3 * n + 1) - 1, 3 * random.uniform(3 * n + 2) - 1.5});
  const TriangleMesh hull = convexHull(points);
  EXPECT_TRUE(isClosed(hull));
  EXPECT_NEAR(solidProperties(hull).volume, 6, 1e-6);
}

TEST(ConvexHull, HoldsAllItsPoints) {
  const Random random(2, Stream::test);
  std::vector<Vec3d> points;
  points.reserve(500);
  for (int n = 0; n < 500; ++n) points.push_back(random.normal3(n) * 1e-3 + Vec3d(1e4, 0, -1e4));
  const TriangleMesh hull = convexHull(points);
  EXPECT_TRUE(isClosed(hull));
  EXPECT_GT(solidProperties(hull).volume, 0);
  for (const auto& [a, b, c] : hull.triangles) {
    const auto& v = hull.vertices;
    const Vec3d n = normalized(cross(v[b] - v[a], v[c] - v[a]));
    for (const Vec3d& p : points) EXPECT_LT(dot(p - v[a], n), 1e-9);
  }
}

TEST(ConvexHull, FlatPointsHaveAClosedHullStill) {
  std::vector<Vec3d> sheet;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) sheet.push_back({0.1 * i, 0.2 * j, 0.3 * i + 0.1 * j});
  EXPECT_TRUE(isClosed(convexHull(sheet)));
  std::vector<Vec3d> line;
  line.reserve(9);
  for (int i = 0; i < 9; ++i) line.push_back({0.1 * i, 0.2 * i, 0.3 * i});
  EXPECT_TRUE(isClosed(convexHull(line)));
  EXPECT_TRUE(isClosed(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})));
  EXPECT_TRUE(convexHull({{1, 2, 3}, {1, 2, 3}}).triangles.empty());
  EXPECT_TRUE(convexHull({}).triangles.empty());
}

}  // namespace
}  // namespace brisance
