#include "mesh/extrusion.h"

#include <gtest/gtest.h>

#include <numeric>

#include "mesh/mass_properties.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

std::vector<std::uint32_t> all(const FlatMesh& flat) {
  std::vector<std::uint32_t> triangles(flat.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0u);
  return triangles;
}

/// Vertices less edges plus triangles, of a closed mesh (three edges to two triangles).
int eulerNumber(const TriangleMesh& mesh) {
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangles.size() / 2);
}

/// A 3x3 chessboard of squares, two triangles each: square (i, j) is triangles 2 (3 j + i) and the next.
FlatMesh chessboard() {
  FlatMesh flat;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 3; ++i) flat.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t v = 4 * j + i;
      flat.triangles.push_back({v, v + 1, v + 5});
      flat.triangles.push_back({v, v + 5, v + 4});
    }
  return flat;
}

TEST(Extrusion, OfOneTriangleIsAPrism) {
  const FlatMesh flat{{{0, 0}, {2, 0}, {0, 3}, {9, 9}}, {{0, 1, 2}}};
  const TriangleMesh prism = extrude(flat, {0}, 0.5);
  EXPECT_EQ(prism.vertices.size(), 6u) << "the unused point is dropped";
  EXPECT_EQ(prism.triangles.size(), 8u);
  EXPECT_TRUE(isClosed(prism));
  EXPECT_NEAR(solidProperties(prism).volume, 1.5, 1e-14);
  EXPECT_EQ(bounds(prism).lower.z, -0.25);
  EXPECT_EQ(bounds(prism).upper.z, 0.25);
}

TEST(Extrusion, OfAWholePaneHasItsVolumeAndMiddle) {
  for (const Triangulation& method : {Triangulation{Trisection{}}, Triangulation{Delaunay{}}}) {
    const FlatMesh flat = triangulate(panePoints(2, 1, 150, 20, 7), method, 7);
    const TriangleMesh pane = extrude(flat, all(flat), 0.004);
    const MassProperties p = solidProperties(pane);
    EXPECT_TRUE(isClosed(pane));
    EXPECT_EQ(eulerNumber(pane), 2);
    // The corners lie on lattice points: 2^-29 of 2 m at most beside their place.
    EXPECT_NEAR(p.volume, 2 * 1 * 0.004, 1e-10);
    EXPECT_NEAR(p.area, 2 * 2 * 1 + 6 * 0.004, 1e-7);
    EXPECT_LT(length(p.centroid), 1e-8);
  }
}

TEST(Extrusion, OfARingHasAHole) {
  const FlatMesh flat = chessboard();
  std::vector<std::uint32_t> ring = all(flat);
  ring.erase(ring.begin() + 8, ring.begin() + 10);
  const TriangleMesh solid = extrude(flat, ring, 0.1);
  EXPECT_TRUE(isClosed(solid));
  EXPECT_EQ(eulerNumber(solid), 0) << "a torus";
  EXPECT_NEAR(solidProperties(solid).volume, 0.8, 1e-13);
}

TEST(Extrusion, SplitsAVertexWhereTwoFansTouch) {
  // Squares (0, 0) and (1, 1) share the point (1, 1) alone.
  const TriangleMesh solid = extrude(chessboard(), {0, 1, 8, 9}, 0.1);
  EXPECT_EQ(solid.vertices.size(), 16u);
  EXPECT_TRUE(isClosed(solid));
  EXPECT_EQ(componentCount(solid), 2);
  EXPECT_NEAR(solidProperties(solid).volume, 0.2, 1e-14);
}

TEST(Extrusion, SidesFaceOutwards) {
  const TriangleMesh solid = extrude(chessboard(), {0, 1, 2, 3, 6, 7}, 0.2);
  // Every side triangle of this L of squares faces away from the side's own square: a step along it leaves the L.
  const auto inside = [](const Vec3d& p) {
    return p.x > 0 && p.y > 0 && ((p.x < 2 && p.y < 1) || (p.x < 1 && p.y < 2));
  };
  for (const auto& [a, b, c] : solid.triangles) {
    const Vec3d n = normalized(cross(solid.vertices[b] - solid.vertices[a], solid.vertices[c] - solid.vertices[a]));
    const Vec3d middle = (solid.vertices[a] + solid.vertices[b] + solid.vertices[c]) / 3.0;
    if (n.z != 0) {
      EXPECT_GT(n.z * middle.z, 0);
    } else {
      EXPECT_TRUE(inside(middle - n * 0.01) && !inside(middle + n * 0.01));
    }
  }
}

}  // namespace
}  // namespace brisance
