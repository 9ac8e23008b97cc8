#include "render/flow_arrows.h"
#include "grid/brick_source.h"

#include <gtest/gtest.h>

#include "mesh/mass_properties.h"

namespace brisance {
namespace {

FrameGas gasOfOneFlow(const Vec3f& velocity) {
  const Grid3<Vec3f> grid({10, 10, 10}, {.05, .05, .05}, .1, velocity);
  FrameGas gas;
  gas.velocity = makeSparse(grid, Vec3f());
  return gas;
}

FlowSettings flatFlow() {
  FlowSettings settings;
  settings.lower = {.2, .5, .2};
  settings.upper = {.8, .5, .8};
  settings.spacing = .2;
  settings.seconds = .05;
  return settings;
}

TEST(FlowArrows, EachIsAsLongAsTheGasGoesAndPointsItsWay) {
  for (const Vec3f& velocity : {Vec3f(1, 0, 0), Vec3f(0, -2, 0), Vec3f(.5f, .5f, -1)}) {
    const TriangleMesh mesh = flowArrows(gasOfOneFlow(velocity), flatFlow());
    constexpr std::size_t arrows = 4 * 4, corners = 16;
    ASSERT_EQ(mesh.vertices.size(), arrows * corners);
    for (std::size_t a = 0; a < arrows; ++a) {
      const auto ring = [&](std::size_t first) {
        Vec3d sum;
        for (std::size_t n = 0; n < 4; ++n) sum += mesh.vertices[corners * a + first + n];
        return sum / 4.0;
      };
      const Vec3d start(.2 + .2 * static_cast<double>(a % 4), .5, .2 + .2 * static_cast<double>(a / 4));
      EXPECT_LT(length(ring(0) - start), 1e-9);
      EXPECT_LT(length(ring(12) - start - Vec3d(velocity) * .05), 1e-6);
    }
    EXPECT_GT(solidProperties(mesh).volume, 0);  // faces outwards
  }
}

TEST(FlowArrows, StillGasHasNone) { EXPECT_TRUE(flowArrows(gasOfOneFlow({}), flatFlow()).triangles.empty()); }

}  // namespace
}  // namespace brisance
