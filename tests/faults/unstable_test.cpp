// A simulation that leaves its range ends with one line that says where, when, and what is left to go back to.
#include <gtest/gtest.h>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

TEST(UnstableRun, NamesTheCellTheStepAndTheLastGoodCheckpoint) {
  const ScratchDirectory place;
  const fs::path scene = place / "hot.toml", run = place / "run";
  std::string text = smallSceneText(12);
  const std::string key = "heating = 75000";
  text.replace(text.find(key), key.size(), key + "\nheat_per_mass = 1e41");  // beyond single precision where fuel burns
  writeText(scene, text);
  // The charge goes off between frames 6 and 7; until then nothing burns.
  const Outcome outcome = runProgram({"simulate", scene, "-o", run, "--set", "explosion.charges.0.time=0.23"});
  expectOneLine(outcome, 5,
                {"frame 7", "sub-step", "temperature at cell (", "is not a finite number", "checkpoint.0006.bin"});
  EXPECT_TRUE(fs::exists(run / "checkpoints/checkpoint.0006.bin"));
  EXPECT_FALSE(fs::exists(run / "gas/gas.0007.vdb")) << "no frame shall be written of a broken state";
  EXPECT_EQ(runProgram({"verify", run}).exitCode, 0);
}

TEST(UnstableRun, WithoutACheckpointSaysSo) {
  const ScratchDirectory place;
  const fs::path scene = place / "hot.toml";
  std::string text = smallSceneText(12);
  const std::string key = "heating = 75000";
  text.replace(text.find(key), key.size(), key + "\nheat_per_mass = 1e41");
  writeText(scene, text);
  const Outcome outcome = runProgram({"simulate", scene, "-o", place / "run"});
  expectOneLine(outcome, 5, {"frame 2", "cell (", "there is no checkpoint yet"});
}

}  // namespace
}  // namespace brisance::test
