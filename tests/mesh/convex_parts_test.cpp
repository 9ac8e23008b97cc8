#include "mesh/convex_parts.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace brisance {
namespace {

/// Whether a point lies in a solid, or outside it by no more than `slack` [m].
bool holds(const ConvexSolid& solid, const Vec3d& p, double slack) {
  for (const ConvexFace& face : solid.faces)
    if (dot(p - solid.points[face.corners[0]], face.normal) > slack) return false;
  return true;
}
bool holds(const std::vector<ConvexSolid>& parts, const Vec3d& p, double slack) {
  return std::any_of(parts.begin(), parts.end(), [&](const ConvexSolid& part) { return holds(part, p, slack); });
}

/// Two boxes that stand against each other, as one closed surface for every purpose here.
TriangleMesh corner() {
  TriangleMesh mesh = boxMesh({1, .2, .1}, false), up = boxMesh({.2, .8, .1}, false);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : up.vertices) mesh.vertices.push_back(v + Vec3d(-.4, .5, 0));
  for (const Triangle& t : up.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

TEST(ConvexSolid, ABoxHasSixFacesOfFourCorners) {
  const ConvexSolid box = convexSolid(boxMesh({1, 2, .005}).vertices);
  EXPECT_EQ(box.points.size(), 8u);
  ASSERT_EQ(box.faces.size(), 6u);
  for (const ConvexFace& face : box.faces) {
    ASSERT_EQ(face.corners.size(), 4u);
    const Vec3d &a = box.points[face.corners[0]], &b = box.points[face.corners[1]], &c = box.points[face.corners[2]];
    EXPECT_GT(dot(cross(b - a, c - b), face.normal), 0) << "counter-clockwise from outside";
    EXPECT_GT(dot(a, face.normal), 0) << "outwards";
  }
  EXPECT_NEAR(thickness(box), .005, 1e-12);
}

TEST(ConvexParts, AConvexMeshIsOnePart) {
  EXPECT_EQ(convexParts(boxMesh({1, .5, .2})).size(), 1u);
  EXPECT_EQ(convexParts(sphereMesh(1, 16)).size(), 1u);
}

TEST(ConvexParts, TheyCoverAHollowMeshAndLeaveItsHollowFree) {
  const std::vector<ConvexSolid> parts = convexParts(corner());
  EXPECT_GT(parts.size(), 1u);
  EXPECT_LE(parts.size(), 16u);
  for (const Vec3d& inside : {Vec3d(-.4, 0, 0), Vec3d(.45, .05, .04), Vec3d(-.45, .85, -.04), Vec3d(0, -.09, 0)})
    EXPECT_TRUE(holds(parts, inside, 1e-9)) << inside.x << " " << inside.y;
  for (const Vec3d& hollow : {Vec3d(.3, .6, 0), Vec3d(-.1, .3, 0), Vec3d(.45, .2, 0)})
    EXPECT_FALSE(holds(parts, hollow, 1e-9)) << hollow.x << " " << hollow.y;
}

}  // namespace
}  // namespace brisance
