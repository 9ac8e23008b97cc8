// A simulation that leaves its range ends with one line that says where, when, and what is left to go back to.
#include <gtest/gtest.h>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

/// With heat beyond single precision where fuel burns, from `time` [s] on.
Outcome simulateTooHot(const fs::path& scene, const fs::path& run, const std::string& time) {
  return runProgram({"simulate", scene, "-o", run, "--quiet", "--set", "explosion.charges.0.time=" + time, "--set",
                     "explosion.heat_per_mass=1e15", "--set", "gas.heat_capacity=1e-23"});
}

TEST(UnstableRun, NamesTheCellTheStepAndTheLastGoodCheckpoint) {
  const ScratchDirectory place;
  const fs::path scene = place / "hot.toml", run = place / "run";
  writeText(scene, smallSceneText(12));
  // The charge goes off between frames 6 and 7 and makes the eighth; until then nothing burns.
  const Outcome outcome = simulateTooHot(scene, run, "0.23");
  expectOneLine(outcome, 5, {"frame 8", "sub-step 1", "at cell (", "is not a finite number", "checkpoint.0006.bin"});
  EXPECT_TRUE(fs::exists(run / "checkpoints/checkpoint.0006.bin"));
  EXPECT_FALSE(fs::exists(run / "gas/gas.0008.vdb")) << "no frame shall be written of a broken state";
  EXPECT_EQ(runProgram({"verify", run}).exitCode, 0);
}

TEST(UnstableRun, WithoutACheckpointSaysSo) {
  const ScratchDirectory place;
  const fs::path scene = place / "hot.toml";
  writeText(scene, smallSceneText(12));
  const Outcome outcome = simulateTooHot(scene, place / "run", "0");
  expectOneLine(outcome, 5, {"frame 2", "cell (", "there is no checkpoint yet"});
}

}  // namespace
}  // namespace brisance::test
