#include "mesh/triangulation.h"

#include <gtest/gtest.h>

#include <set>

#include "base/check.h"
#include "mesh/flat_samples.h"
#include "mesh/lattice_points.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

const std::vector<Triangulation> bothMethods{Trisection{}, Delaunay{}};

double area(const FlatMesh& mesh, const Triangle& t) {
  const Vec2d ab = mesh.points[t[1]] - mesh.points[t[0]], ac = mesh.points[t[2]] - mesh.points[t[0]];
  return (ab.x * ac.y - ab.y * ac.x) / 2;
}
double totalArea(const FlatMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += area(mesh, t);
  return sum;
}
double smallestAngle(const FlatMesh& mesh) {
  double smallest = pi;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec2d a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]],
                  b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      smallest = std::min(smallest, std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
    }
  return smallest;
}
std::size_t usedPoints(const FlatMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  return used.size();
}
/// Area by the exact integer predicate: it cannot be zero by rounding.
bool allTurnLeft(const FlatMesh& mesh) {
  const LatticePoints lattice = snapToLattice(mesh.points);
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return orientation(lattice.nodes[t[0]], lattice.nodes[t[1]], lattice.nodes[t[2]]) > 0;
  });
}
/// A triangulation of n points, h of them on the border, has 2 n - h - 2 triangles (Euler), and one connected border.
void expectTriangulation(const FlatMesh& mesh, std::size_t borderPoints) {
  EXPECT_EQ(mesh.triangles.size(), 2 * usedPoints(mesh) - borderPoints - 2);
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
  std::size_t border = 0;
  for (const Triangle& row : neighbours)
    border += static_cast<std::size_t>(std::count(row.begin(), row.end(), noTriangle));
  EXPECT_EQ(border, borderPoints);
  EXPECT_TRUE(allTurnLeft(mesh));
}
bool isDelaunay(const FlatMesh& mesh) {
  const LatticePoints lattice = snapToLattice(mesh.points);
  for (const Triangle& t : mesh.triangles)
    for (const LatticePoint& p : lattice.nodes)
      if (insideCircle(lattice.nodes[t[0]], lattice.nodes[t[1]], lattice.nodes[t[2]], p)) return false;
  return true;
}
std::vector<Vec2d> integerGrid(int columns, int rows) {
  std::vector<Vec2d> points;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  return points;
}

TEST(PanePoints, LieInThePaneAndOnItsBorderAsAsked) {
  const std::vector<Vec2d> points = panePoints(2, 1.5, 100, 37, 4);
  ASSERT_EQ(points.size(), 141u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double toBorder = std::min(1 - std::abs(points[i].x), 0.75 - std::abs(points[i].y));
    EXPECT_GE(toBorder, 0);
    const bool onBorder = i < 4 || i >= 104;
    EXPECT_EQ(toBorder == 0, onBorder);
  }
}

TEST(PanePoints, AreTheSameForASeedAndOthersForAnother) {
  EXPECT_EQ(panePoints(1, 1, 50, 10, 1), panePoints(1, 1, 50, 10, 1));
  EXPECT_NE(panePoints(1, 1, 50, 10, 1), panePoints(1, 1, 50, 10, 2));
}

TEST(Triangulation, OfAPaneFillsItWithEveryPoint) {
  for (const Triangulation& method : bothMethods)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto count = static_cast<int>(10 * seed);
      const std::vector<Vec2d> points = panePoints(1.3, 0.7, count, count / 3, seed);
      const FlatMesh mesh = triangulate(points, method, seed);
      EXPECT_EQ(usedPoints(mesh), points.size());
      expectTriangulation(mesh, 4 + static_cast<std::size_t>(count / 3));
      // Corners move by half a lattice step at most: 2^-30 of the larger side.
      EXPECT_NEAR(totalArea(mesh), 1.3 * 0.7, 4e-9);
    }
}

TEST(Triangulation, MovesPointsByNoMoreThanALatticeStep) {
  const std::vector<Vec2d> points = panePoints(3, 1, 200, 40, 9);
  const FlatMesh mesh = triangulate(points, Delaunay{}, 9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(mesh.points[i].x, points[i].x, 3 * 0x1p-29);
    EXPECT_NEAR(mesh.points[i].y, points[i].y, 3 * 0x1p-29);
  }
}

TEST(Triangulation, OfPointsInLinesOnAGridIsWhole) {
  for (const Triangulation& method : bothMethods) {
    for (int columns : {2, 3, 9})
      for (int rows : {2, 5, 8}) {
        const FlatMesh mesh = triangulate(integerGrid(columns, rows), method, 3);
        EXPECT_EQ(usedPoints(mesh), static_cast<std::size_t>(columns * rows));
        expectTriangulation(mesh, static_cast<std::size_t>(2 * (columns + rows) - 4));
        EXPECT_EQ(totalArea(mesh), (columns - 1) * (rows - 1));
      }
  }
}

TEST(Triangulation, OfATriangleWithPointsOnlyOnItsEdgesIsWhole) {
  const std::vector<Vec2d> points{{0, 0}, {4, 0}, {0, 4}, {1, 0}, {2, 0}, {3, 0},
                                  {0, 1}, {0, 2}, {1, 3}, {2, 2}, {3, 1}};
  for (const Triangulation& method : bothMethods)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const FlatMesh mesh = triangulate(points, method, seed);
      EXPECT_EQ(usedPoints(mesh), points.size());
      expectTriangulation(mesh, points.size());
      EXPECT_EQ(totalArea(mesh), 8);
    }
}

TEST(Triangulation, OfManyPointsOnACircleIsWhole) {
  // Integer points at distance 65 from the middle: exactly on one circle.
  std::vector<Vec2d> points;
  for (int x = -65; x <= 65; ++x)
    for (int y = -65; y <= 65; ++y)
      if (x * x + y * y == 65 * 65) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  ASSERT_EQ(points.size(), 36u);
  for (const Triangulation& method : bothMethods) {
    expectTriangulation(triangulate(points, method, 1), 36);
    points.push_back({0, 0});
    expectTriangulation(triangulate(points, method, 1), 36);
    points.pop_back();
  }
}

TEST(Triangulation, OfPointsNearlyInLineKeepsThemAll) {
  // Points on a parabola so flat that they leave the line by a few lattice steps, above points that hold the pane open.
  std::vector<Vec2d> points{{0, 1}, {0.3, 0.8}, {1, 1}};
  for (int i = 0; i <= 40; ++i) {
    const double x = i / 40.0;
    points.push_back({x, (x - 0.5) * (x - 0.5) * 1e-7});
  }
  for (const Triangulation& method : bothMethods) {
    const FlatMesh mesh = triangulate(points, method, 2);
    EXPECT_EQ(usedPoints(mesh), points.size());
    EXPECT_TRUE(allTurnLeft(mesh));
  }
  EXPECT_TRUE(isDelaunay(triangulate(points, Delaunay{}, 2)));
}

TEST(Triangulation, UsesPointsThatCoincideOnce) {
  std::vector<Vec2d> points = panePoints(1, 1, 30, 8, 5);
  const std::size_t distinct = points.size();
  points.insert(points.end(), {points[0], points[10], points[10], points[20]});
  for (const Triangulation& method : bothMethods) {
    const FlatMesh mesh = triangulate(points, method, 5);
    EXPECT_EQ(usedPoints(mesh), distinct);
    EXPECT_EQ(mesh.points.size(), points.size());
    expectTriangulation(mesh, 12);
  }
}

TEST(Triangulation, RefusesPointsOnOneLine) {
  for (const Triangulation& method : bothMethods) {
    EXPECT_THROW(triangulate({}, method, 1), InputError);
    EXPECT_THROW(triangulate({{1, 1}}, method, 1), InputError);
    EXPECT_THROW(triangulate({{1, 1}, {1, 1}, {1, 1}}, method, 1), InputError);
    EXPECT_THROW(triangulate({{0, 0}, {2, 2}, {1, 1}, {3, 3}}, method, 1), InputError);
  }
}

TEST(Triangulation, IsTheSameEveryTime) {
  const std::vector<Vec2d> points = panePoints(1, 1, 300, 40, 8);
  for (const Triangulation& method : bothMethods)
    EXPECT_EQ(triangulate(points, method, 8).triangles, triangulate(points, method, 8).triangles);
  EXPECT_NE(triangulate(points, Trisection{}, 8).triangles, triangulate(points, Trisection{}, 9).triangles);
}

TEST(Delaunay, NoCircleHoldsAnotherPoint) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_TRUE(isDelaunay(triangulate(panePoints(1, 2, 200, 30, seed), Delaunay{}, seed)));
  EXPECT_TRUE(isDelaunay(triangulate(integerGrid(12, 7), Delaunay{}, 1)));
}

TEST(Delaunay, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<Vec2d> points = panePoints(1, 1, 100, 0, 3);
  const std::vector<Vec2d> reversed(points.rbegin(), points.rend());
  // Points in general position have one Delaunay triangulation.
  EXPECT_EQ(shapesOf(triangulate(points, Delaunay{}, 1)), shapesOf(triangulate(reversed, Delaunay{}, 1)));
}

TEST(Delaunay, HasTheLargestSmallestAngle) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::vector<Vec2d> points = panePoints(1, 1, 200, 30, seed);
    EXPECT_GE(smallestAngle(triangulate(points, Delaunay{}, seed)),
              smallestAngle(triangulate(points, Trisection{}, seed)));
  }
}

}  // namespace
}  // namespace brisance
