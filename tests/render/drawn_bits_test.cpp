#include "render/drawn_bits.h"

#include <gtest/gtest.h>

namespace brisance {
namespace {

void add(FrameParticles& p, FrameKind kind, const Vec3f& place, const Vec3f& velocity, float temperature) {
  p.position.push_back(place);
  p.velocity.push_back(velocity);
  p.mass.push_back(1e-6f);
  p.temperature.push_back(temperature);
  p.kind.push_back(static_cast<std::uint8_t>(kind));
}

struct Drawn {
  std::vector<FrameBody> bodies;
  std::map<std::string, Material> materials;
};
Drawn drawn(const Frame& frame, const BitsLook& look) {
  Drawn result;
  addBits(frame, look, BlackbodyColours(PhysicalBlackbody{}), result.bodies, result.materials);
  return result;
}

TEST(DrawnBits, NothingIsAddedWithoutThem) {
  Frame frame;
  add(frame.particles, FrameKind::soot, {0, 0, 0}, {1, 0, 0}, 2000);
  EXPECT_TRUE(drawn(frame, {}).bodies.empty());
  EXPECT_TRUE(drawn(frame, {}).materials.empty());
}

TEST(DrawnBits, AStreakEndsAtItsSparkAndIsAsLongAsItsWay) {
  Frame frame;
  add(frame.particles, FrameKind::spark, {1, 2, 3}, {0, -10, 4}, 2000);
  BitsLook look;
  look.sparkSeconds = .01;
  const Drawn result = drawn(frame, look);
  ASSERT_EQ(result.bodies.size(), 1u);
  const TriangleMesh& mesh = *result.bodies[0].mesh;
  EXPECT_LT(length(mesh.vertices.front() - Vec3d(1, 2.1, 2.96)), 1e-6);
  EXPECT_LT(length(mesh.vertices.back() - Vec3d(1, 2, 3)), 1e-6);
  for (std::size_t v = 1; v + 1 < mesh.vertices.size(); ++v)
    EXPECT_NEAR(length(mesh.vertices[v] - Vec3d(1, 2.05, 2.98)), look.sparkWidth / 2, 1e-5);
}

TEST(DrawnBits, SparksShineByTheirHeatUntilTheyAreTooColdToBeSeen) {
  Frame frame;
  for (const float temperature : {2350.0f, 1450.0f, 320.0f})
    add(frame.particles, FrameKind::spark, {0, 0, 0}, {1, 0, 0}, temperature);
  const Drawn result = drawn(frame, {});
  ASSERT_EQ(result.bodies.size(), 2u);
  const Vec3f dim = result.materials.at(result.bodies[0].material).emission,
              bright = result.materials.at(result.bodies[1].material).emission;
  EXPECT_GT(bright.x, 5 * dim.x);
  EXPECT_GT(bright.z / bright.x, dim.z / dim.x);  // hotter is whiter
  EXPECT_GT(dim.x, dim.z);
}

TEST(DrawnBits, AGrainLiesWhereItIsAndTurnsFromFrameToFrame) {
  Frame frame;
  add(frame.particles, FrameKind::dust, {1, 0, 0}, {0, 0, 0}, 300);
  add(frame.particles, FrameKind::dust, {2, 0, 0}, {0, 0, 0}, 300);
  BitsLook look;
  look.grainSize = .02;
  const Drawn first = drawn(frame, look);
  ASSERT_EQ(first.bodies.size(), 1u);
  const TriangleMesh& mesh = *first.bodies[0].mesh;
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      EXPECT_LT(length(mesh.vertices[v] - Vec3d(1.0 + static_cast<double>(t), 0, 0)), look.grainSize);
  EXPECT_EQ(drawn(frame, look).bodies[0].mesh->vertices, mesh.vertices);
  frame.index = 2;
  EXPECT_NE(drawn(frame, look).bodies[0].mesh->vertices, mesh.vertices);
}

}  // namespace
}  // namespace brisance
