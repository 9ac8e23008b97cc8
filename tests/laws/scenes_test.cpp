// Scenes of the project show what they say.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene_file.h"
#include "simulation/world.h"

namespace brisance::test {
namespace {

/// How far two directions in the x-z plane are apart, counter-clockwise seen from above [rad].
double turnBetween(const Vec3d& a, const Vec3d& b) { return std::atan2(a.z * b.x - a.x * b.z, a.x * b.x + a.z * b.z); }

struct CircularFlow {
  double round = 0;    ///< [rad] that the block has gone about the middle
  double turned = 0;   ///< [rad] about itself
  double height = 0;   ///< [m] it has left the middle plane
  double inwards = 0;  ///< [m] that it ever came back towards the middle
  double start, end;   ///< [m] from the middle
};

CircularFlow followBlock(bool clockwise) {
  Scene scene = readScene(BRISANCE_SOURCE_DIR "/scenes/circular_flow.toml");
  if (clockwise) scene.simulation.fluid.stirring[0].angularSpeed *= -1;
  World world(scene.simulation);
  const auto block = [&] { return world.capture().bodies.at(0); };
  FrameBody before = block();
  CircularFlow flow{.start = length(Vec3d(before.pose.position.x, 0, before.pose.position.z)), .end = 0};
  double farthest = flow.start;
  while (world.frameIndex() < scene.simulation.frames) {
    world.advance();
    const FrameBody now = block();
    const Vec3d side(1, 0, 0);
    flow.round += turnBetween(before.pose.position, now.pose.position);
    flow.turned += turnBetween(rotate(before.pose.orientation, side), rotate(now.pose.orientation, side));
    flow.height = std::max(flow.height, std::abs(now.pose.position.y - before.pose.position.y));
    flow.end = length(Vec3d(now.pose.position.x, 0, now.pose.position.z));
    flow.inwards = std::max(flow.inwards, farthest - flow.end);
    farthest = std::max(farthest, flow.end);
    before = now;
  }
  return flow;
}

/// The thesis' Figure 5.1: a block goes round with a stirred fluid, turns, and drifts outwards.
TEST(Scenes, InACircularFlowABlockGoesRoundTurnsAndDriftsOutwards) {
  for (const bool clockwise : {false, true}) {
    const CircularFlow flow = followBlock(clockwise);
    const double sense = clockwise ? -1 : 1;
    EXPECT_GT(sense * flow.round, 1.8 * pi);  // nearly once
    EXPECT_GT(sense * flow.turned, 1.5 * pi);
    EXPECT_GT(flow.end, 3 * flow.start);
    EXPECT_LT(flow.inwards, 1e-3);
    EXPECT_LT(flow.height, 1e-3);
  }
}

}  // namespace
}  // namespace brisance::test
