// Triangulations of what an outline encloses.
#include <gtest/gtest.h>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "mesh/extrusion.h"
#include "mesh/flat_samples.h"
#include "mesh/mass_properties.h"

namespace brisance {
namespace {

const std::vector<Triangulation> bothMethods{Trisection{}, Delaunay{}};

/// Calls check(outline, pane, method) for many panes.
template <class Check>
void forManyPanes(const Check& check) {
  const std::vector<Outline> outlines = sampleOutlines();
  for (std::size_t o = 0; o < outlines.size(); ++o)
    for (const PointPattern& pattern : samplePatterns(o))
      for (const Triangulation& method : bothMethods)
        for (const int count : {1, 5, 60, 400})
          for (std::uint64_t seed = 1; seed <= 3; ++seed)
            check(cornersFor(outlines[o], count), placePoints(outlines[o], pattern, count, seed), method);
}

TEST(OutlinedTriangulation, FillsTheOutlineWithEveryPoint) {
  forManyPanes([](const std::vector<Vec2d>& corners, const PanePoints& pane, const Triangulation& method) {
    const FlatMesh mesh = triangulatePane(pane, method, 1);
    const Vec3d size = polygonBounds(corners).size();
    const double extent = std::max(size.x, size.y), area = polygonArea(corners);
    EXPECT_EQ(pointsUsed(mesh), pane.points.size());
    // A simple polygon of b border points and n points in all has 2 n - b - 2 triangles (Euler).
    EXPECT_EQ(mesh.triangles.size(), 2 * pane.points.size() - pane.border.size() - 2);
    // Border points move by half a lattice step of 2^-29 of the extent at most, along at most 4 extents of border.
    EXPECT_NEAR(totalAreaOf(mesh), area, 4 * extent * extent * 0x1p-29);
    const LatticePoints lattice = snapToLattice(mesh.points);
    for (const Triangle& t : mesh.triangles)
      EXPECT_GT(orientation(lattice.nodes[t[0]], lattice.nodes[t[1]], lattice.nodes[t[2]]), 0);
  });
}

TEST(OutlinedTriangulation, HasExactlyTheOutlineAsItsBorder) {
  forManyPanes([](const std::vector<Vec2d>&, const PanePoints& pane, const Triangulation& method) {
    const FlatMesh mesh = triangulatePane(pane, method, 1);
    std::set<std::pair<std::uint32_t, std::uint32_t>> wanted, found;
    for (std::size_t i = 0; i < pane.border.size(); ++i)
      wanted.insert({pane.border[i], pane.border[(i + 1) % pane.border.size()]});
    const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        if (neighbours[t][e] == noTriangle) found.insert({mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]});
    EXPECT_EQ(found, wanted);
  });
}

TEST(OutlinedTriangulation, IsDelaunayAcrossEveryInnerEdge) {
  for (std::size_t o = 0; o < sampleOutlines().size(); ++o)
    for (const PointPattern& pattern : samplePatterns(o)) {
      const FlatMesh mesh = triangulatePane(placePoints(sampleOutlines()[o], pattern, 300, 2), Delaunay{}, 2);
      const LatticePoints lattice = snapToLattice(mesh.points);
      const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t other : neighbours[t]) {
          if (other == noTriangle) continue;
          const auto& [a, b, c] = mesh.triangles[t];
          for (const std::uint32_t d : mesh.triangles[other])
            EXPECT_FALSE(insideCircle(lattice.nodes[a], lattice.nodes[b], lattice.nodes[c], lattice.nodes[d]));
        }
    }
}

/// A comb whose long teeth the Delaunay triangulation of its corners runs across: `teeth` of width 1 and gaps of 0.05.
std::vector<Vec2d> comb(int teeth, double length) {
  std::vector<Vec2d> corners{{0, -1}, {teeth * 1.05, -1}};
  for (int i = teeth - 1; i >= 0; --i)
    for (const Vec2d& p : {Vec2d{1.05, 0}, Vec2d{1.05, length}, Vec2d{0.05, length * 1.01}, Vec2d{0.05, 0}})
      corners.push_back({i * 1.05 + p.x - 0.01 * (p.x > 1), p.y});
  return corners;
}

TEST(OutlinedTriangulation, BringsInEdgesThatCrossManyTriangles) {
  const std::vector<Vec2d> corners = comb(12, 9);
  PanePoints pane{corners, {}};
  for (std::uint32_t i = 0; i < corners.size(); ++i) pane.border.push_back(i);
  const Vec3d size = polygonBounds(corners).size();
  for (const Triangulation& method : bothMethods) {
    const FlatMesh mesh = triangulatePane(pane, method, 1);
    EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
    EXPECT_NEAR(totalAreaOf(mesh), polygonArea(corners), 30 * size.x * size.x * 0x1p-29);
  }
}

TEST(OutlinedTriangulation, RefusesABorderThroughAPoint) {
  const PanePoints pane{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}, {1, 2.5}}, {0, 1, 2, 3, 4}};
  for (const Triangulation& method : bothMethods) {
    PanePoints through = pane;
    through.points.push_back({3, 2.5});  // the middle of an edge
    EXPECT_THROW(triangulatePane(through, Delaunay{}, 1), InputError);
    PanePoints crossed = pane;
    crossed.border = {0, 2, 1, 4};
    EXPECT_THROW(triangulatePane(crossed, method, 1), InputError);
    PanePoints twice = pane;
    twice.border = {0, 1, 3, 2, 3, 4};
    EXPECT_THROW(triangulatePane(twice, method, 1), InputError);
    PanePoints line{{{0, 0}, {1, 1}, {2, 2}}, {0, 1, 2}};
    EXPECT_THROW(triangulatePane(line, method, 1), InputError);
  }
}

TEST(OutlinedTriangulation, ExtrudesToAClosedSolidOfItsAreaTimesThickness) {
  forManyPanes([](const std::vector<Vec2d>&, const PanePoints& pane, const Triangulation& method) {
    if (pane.points.size() > 250) return;
    const FlatMesh flat = triangulatePane(pane, method, 1);
    std::vector<std::uint32_t> all(flat.triangles.size());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const TriangleMesh solid = extrude(flat, all, 0.02);
    EXPECT_TRUE(isClosed(solid));
    EXPECT_EQ(componentCount(solid), 1);
    const double volume = totalAreaOf(flat) * 0.02;
    EXPECT_NEAR(solidProperties(solid).volume, volume, 1e-12 * volume);
    // One disc made thick is a ball's surface: V - E + F = 2, with 3 F = 2 E.
    EXPECT_EQ(2 * solid.vertices.size(), solid.triangles.size() + 4);
  });
}

TEST(Extrusion, StretchesAPictureOverBothFaces) {
  const FlatMesh flat = triangulatePane(placePoints(arrowOutline(), UniformPoints{}, 50, 1), Delaunay{}, 1);
  for (const std::uint32_t triangle : {0u, 7u, 30u}) {
    const TriangleMesh piece = extrude(flat, {triangle}, 0.1);
    ASSERT_EQ(piece.uvs.size(), piece.vertices.size());
    for (std::size_t i = 0; i < piece.uvs.size(); ++i) {
      // The arrow's box is 1.1 x 1 m from the origin.
      EXPECT_NEAR(piece.uvs[i].x, piece.vertices[i].x / 1.1, 1e-8);
      EXPECT_NEAR(piece.uvs[i].y, piece.vertices[i].y, 1e-8);
    }
  }
}

TEST(Delaunay, OfPointsOnCirclesDoesNotDependOnTheirOrder) {
  // A grid, where every square's corners lie on one circle, and many points at distance 65: ties everywhere.
  std::vector<Vec2d> points;
  for (int x = -65; x <= 65; ++x)
    for (int y = -65; y <= 65; ++y)
      if (x * x + y * y == 65 * 65 || (x % 13 == 0 && y % 13 == 0 && std::abs(x) + std::abs(y) < 60))
        points.push_back({static_cast<double>(x), static_cast<double>(y)});
  const auto whole = shapesOf(triangulate(points, Delaunay{}, 1));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Random random(seed, Stream::test);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i, i)]);
    EXPECT_EQ(shapesOf(triangulate(points, Delaunay{}, 1)), whole);
  }
}

TEST(Delaunay, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Vec2d> points = panePoints(1, 2, 20000, 100, 4);
  const auto onThreads = [&](int threads) {
    const ThreadLimit limit(threads);
    return triangulate(points, Delaunay{}, 1).triangles;
  };
  EXPECT_EQ(onThreads(1), onThreads(2));
  EXPECT_EQ(onThreads(1), onThreads(5));
}

TEST(Delaunay, OfManyPointsIsWholeAndLocallyDelaunay) {
  // 20000 points are worked on in parts; locally Delaunay everywhere is Delaunay (Delaunay's lemma).
  std::vector<Vec2d> points = panePoints(3, 1, 20000, 400, 4);
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) points.push_back({i / 64.0 - 0.5, j / 128.0 - 0.25});  // and a grid among them
  const FlatMesh mesh = triangulate(points, Delaunay{}, 1);
  EXPECT_EQ(pointsUsed(mesh), points.size());
  EXPECT_EQ(mesh.triangles.size(), 2 * points.size() - 404 - 2);
  const LatticePoints lattice = snapToLattice(mesh.points);
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t other : neighbours[t]) {
      const auto& [a, b, c] = mesh.triangles[t];
      ASSERT_GT(orientation(lattice.nodes[a], lattice.nodes[b], lattice.nodes[c]), 0);
      if (other == noTriangle) continue;
      for (const std::uint32_t d : mesh.triangles[other])
        ASSERT_FALSE(insideCircle(lattice.nodes[a], lattice.nodes[b], lattice.nodes[c], lattice.nodes[d]));
    }
}

TEST(InsideCircle, AgreesWithExactArithmeticNearTheCircle) {
  // Points at distance 5 * 2^k from the middle lie exactly on the circle; a step in or out is told apart.
  for (const int k : {0, 10, 26}) {
    const std::int32_t s = 1 << k, m = 1 << 29;
    const auto at = [&](int x, int y) { return LatticePoint{m + x * s, m + y * s}; };
    const LatticePoint a = at(5, 0), b = at(0, 5), c = at(-3, -4), on = at(3, -4);
    EXPECT_EQ(circleSide(a, b, c, on), 0);
    EXPECT_GT(circleSide(a, b, c, {on.x - 1, on.y}), 0);
    EXPECT_LT(circleSide(a, b, c, {on.x + 1, on.y}), 0);
  }
}

}  // namespace
}  // namespace brisance
