#include "render/scene_geometry.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "render/dielectric.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

constexpr float rounding = 1e-5f;  // [m] of places of a few metres in float

Ray down(float x = 0, float z = 0) { return {{x, 5, z}, {0, -1, 0}}; }

FrameBody paneAt(const std::string& name, const Vec3d& place, const std::string& material = "glass") {
  return bodyOf(name, boxMesh({1, 0.1, 1}), material, {place, {}});
}

}  // namespace

TEST(SceneGeometry, FindsTheNearestSurfaceAndItsOutwardNormalFromBothSides) {
  const SmallWorld world({bodyOf("box", boxMesh({1, 2, 1}), "paint")}, {{"paint", whitePaint()}});
  SurfaceHit hit;
  ASSERT_TRUE(world.geometry().closest(down(), hit));
  EXPECT_NEAR(hit.distance, 4, rounding);
  EXPECT_NEAR(hit.normal.y, 1, rounding);
  ASSERT_TRUE(world.geometry().closest({{0, 0, 0}, {0, -1, 0}}, hit));  // from inside
  EXPECT_NEAR(hit.distance, 1, rounding);
  EXPECT_NEAR(hit.normal.y, -1, rounding);
  EXPECT_FALSE(world.geometry().closest(down(2), hit));
}

TEST(SceneGeometry, BodiesStandWhereTheirPosesPutThem) {
  const Pose pose{{3, 1, 0}, axisAngle({0, 0, 1}, pi / 2)};
  const SmallWorld world({bodyOf("box", boxMesh({1, 4, 1}), "paint", pose)}, {{"paint", whitePaint()}});
  SurfaceHit hit;
  ASSERT_TRUE(world.geometry().closest(down(4.5f), hit));  // the long side lies along x now
  EXPECT_NEAR(hit.distance, 3.5, rounding);
  EXPECT_FALSE(world.geometry().closest(down(0.9f), hit));
}

TEST(SceneGeometry, SmoothMaterialsHaveNormalsBetweenTheVertices) {
  Material smooth = whitePaint();
  smooth.smooth = true;
  for (const bool given : {true, false}) {
    TriangleMesh mesh = sphereMesh(1, 64, false);
    if (!given) mesh.normals.clear();
    const SmallWorld world({bodyOf("ball", mesh, "paint", {{}, axisAngle({1, 0, 0}, 1)})}, {{"paint", smooth}});
    SurfaceHit hit;
    for (const float x : {0.1f, 0.33f, -0.5f}) {
      ASSERT_TRUE(world.geometry().closest(down(x, 0.2f), hit));
      const Vec3f place(x, 5 - hit.distance, 0.2f);
      EXPECT_GT(dot(hit.shadingNormal, normalized(place)),
                given ? 0.99999f : 0.9999f);  // facets of 5.6 degrees: 0.9988
      EXPECT_NEAR(length(hit.shadingNormal), 1, rounding);
    }
  }
}

TEST(SceneGeometry, AMaterialThatIsNotDefinedIsNamedWithItsBody) {
  try {
    const SmallWorld world({bodyOf("pane.007", boxMesh({1, 1, 1}), "galss")}, {{"glass", clearGlass()}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string line = error.what();
    for (const char* part : {"pane.007", "galss", "glass"}) EXPECT_NE(line.find(part), std::string::npos) << line;
  }
}

TEST(SceneGeometry, TrianglesMayHaveMaterialsOfTheirOwn) {
  TriangleMesh mesh = boxMesh({1, 1, 1});
  mesh.materialNames = {"paint", "unknown"};
  mesh.materials.assign(mesh.triangles.size(), 1);
  const SmallWorld own({bodyOf("box", mesh, "lamp")}, {{"lamp", lamp({1, 1, 1})}, {"paint", whitePaint()}});
  SurfaceHit hit;
  ASSERT_TRUE(own.geometry().closest(down(), hit));
  EXPECT_EQ(hit.material, 0);  // unknown to the settings: the body's, "lamp", first in the alphabet
  mesh.materials.assign(mesh.triangles.size(), 0);
  const SmallWorld named({bodyOf("box", mesh, "lamp")}, {{"lamp", lamp({1, 1, 1})}, {"paint", whitePaint()}});
  ASSERT_TRUE(named.geometry().closest(down(), hit));
  EXPECT_EQ(hit.material, 1);
}

TEST(Shadow, OpaqueBodiesBlockLightBetweenAndNotBeyond) {
  const SmallWorld world({bodyOf("box", boxMesh({1, 1, 1}), "paint")}, {{"paint", whitePaint()}});
  EXPECT_EQ(world.geometry().lightPassing(down(), 10), Vec3f{});
  EXPECT_EQ(world.geometry().lightPassing(down(), 3), Vec3f(1, 1, 1));
  EXPECT_EQ(world.geometry().lightPassing(down(2), 10), Vec3f(1, 1, 1));
}

TEST(Shadow, BodiesThatCastNoneLetLightPass) {
  Material ghost = whitePaint();
  ghost.castsShadow = false;
  const SmallWorld world({bodyOf("box", boxMesh({1, 1, 1}), "ghost")}, {{"ghost", ghost}});
  EXPECT_EQ(world.geometry().lightPassing(down(), 10), Vec3f(1, 1, 1));
}

// Two surfaces return 4 % each, and 0.1 m absorb exp(-0.1 * absorption).
TEST(Shadow, GlassDimsLightByItsSurfacesAndItsThickness) {
  Material glass = clearGlass();
  glass.absorption = {0, 2, 5};
  const SmallWorld world({paneAt("pane", {0, 0, 0})}, {{"glass", glass}});
  const Vec3f passing = world.geometry().lightPassing(down(0.1f, 0.2f), 10);
  EXPECT_NEAR(passing.x, 0.96 * 0.96, rounding);
  EXPECT_NEAR(passing.y, 0.96 * 0.96 * std::exp(-0.2), rounding);
  EXPECT_NEAR(passing.z, 0.96 * 0.96 * std::exp(-0.5), rounding);
  const Ray fromInside{{0.1f, 0, 0.2f}, {0, 1, 0}};
  EXPECT_NEAR(world.geometry().lightPassing(fromInside, 10).y, 0.96 * std::exp(-0.1), rounding);
}

// One that enters and does not leave: a light inside, or an edge whose other side was missed.
TEST(Shadow, GlassNeverAddsLight) {
  Material glass = clearGlass();
  glass.absorption = {0, 2, 5};
  const SmallWorld world({paneAt("pane", {0, 0, 0})}, {{"glass", glass}});
  const Vec3f passing = world.geometry().lightPassing(down(0.1f, 0.2f), 5);  // ends in the pane
  for (const float channel : {passing.x, passing.y, passing.z}) {
    EXPECT_LT(channel, 1);
    EXPECT_GT(channel, 0);
  }
}

TEST(TouchingGlass, HasNoSurfaceBetweenItsPieces) {
  const auto touches = [](const std::vector<FrameBody>& bodies, const Ray& ray) {
    Material tinted = clearGlass();
    tinted.absorption = {1, 1, 1};
    const SmallWorld world(bodies, {{"glass", clearGlass()}, {"tinted", tinted}});
    SurfaceHit hit;
    EXPECT_TRUE(world.geometry().closest(ray, hit));
    return world.geometry().touchesSameGlass(ray, hit);
  };
  const Ray fromInside{{0.1f, 0, 0.2f}, {0, -1, 0}};
  EXPECT_TRUE(touches({paneAt("a", {0, 0, 0}), paneAt("b", {0, -0.1, 0})}, fromInside));
  EXPECT_FALSE(touches({paneAt("a", {0, 0, 0}), paneAt("b", {0, -0.101, 0})}, fromInside));
  EXPECT_FALSE(touches({paneAt("a", {0, 0, 0}), paneAt("b", {0, -0.1, 0}, "tinted")}, fromInside));
  EXPECT_FALSE(touches({paneAt("a", {0, 0, 0})}, fromInside));
  EXPECT_FALSE(touches({paneAt("a", {0, 0, 0}), paneAt("b", {0, -0.1, 0})}, down(0.1f, 0.2f)));  // the outer surface
}
