#include "simulation/simulate.h"

#include <gtest/gtest.h>

#include "scratch_directory.h"
#include "simulation/run_writer.h"
#include "simulation/small_scene.h"

namespace brisance {
namespace {
using namespace test;

/// A run may be killed between its last checkpoint and the removal of those before.
TEST(Simulate, AFinishedRunThatIsResumedForgetsOlderCheckpoints) {
  SimulationSettings settings = smallScene();
  settings.frames = 3;
  const ScratchDirectory scratch;
  RunDirectory run(scratch / "run", RunDirectory::Mode::create);
  simulate(settings, run, {});
  const std::vector<std::string> alone = checkpointsOf(run);
  ASSERT_EQ(alone.size(), 1u);
  run.add(stageCheckpoint(run, 2, [](std::ostream& out) { out << "left behind"; }));
  const std::vector<std::string> both = checkpointsOf(run);
  ASSERT_EQ(both.size(), 2u);
  simulate(settings, run, {});
  EXPECT_EQ(checkpointsOf(run), alone);
  EXPECT_FALSE(std::filesystem::exists(run.path() / both.front()));
}

}  // namespace
}  // namespace brisance
