// Scenes and command lines that are wrong: one line that says what and where, the promised exit code, nothing written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

/// A scene file with some text replaced or added, and what `run` makes of it.
struct Attempt {
  explicit Attempt(const std::string& text) { writeText(scene, text); }
  Outcome simulate(const std::vector<std::string>& extra = {}) {
    std::vector<std::string> arguments{"simulate", scene, "-o", run};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return runProgram(arguments);
  }
  ScratchDirectory place;
  fs::path scene = place / "scene.toml", run = place / "run";
};

std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::logic_error(before + " is not in the scene");
  return text.replace(at, before.size(), after);
}

/// One line that begins with the scene's name and the line number, and holds each of the words.
void expectRefusal(Attempt& attempt, int exitCode, const std::vector<std::string>& words) {
  const Outcome outcome = attempt.simulate();
  expectOneLine(outcome, exitCode, words);
  EXPECT_TRUE(outcome.err.starts_with(attempt.scene.string() + ":")) << outcome.err;
  EXPECT_FALSE(fs::exists(attempt.run)) << "nothing shall be made of a wrong scene";
}

TEST(WrongScene, AnUnknownKeyIsAnErrorThatSuggestsTheNearestKnownOne) {
  Attempt attempt(replaced(smallSceneText(2), "buoyancy", "bouyancy"));
  expectRefusal(attempt, 2, {"bouyancy", "did you mean", "buoyancy"});
}

TEST(WrongScene, AWrongTypeIsNamedWithItsLine) {
  Attempt attempt(replaced(smallSceneText(2), "buoyancy = 0.01", "buoyancy = \"strong\""));
  expectRefusal(attempt, 2, {"gas.buoyancy", "strong"});
  const std::string before = smallSceneText(2).substr(0, smallSceneText(2).find("buoyancy"));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  EXPECT_NE(attempt.simulate().err.find(fmt::format(":{}:", line)), std::string::npos);
}

TEST(WrongScene, ANegativeSizeSaysWhatWouldBeRight) {
  Attempt attempt(replaced(smallSceneText(2), "size = [1.0, 1.0, 1.0]", "size = [1.0, -1.0, 1.0]"));
  expectRefusal(attempt, 2, {"gas.size", "above 0", "[m]", "-1"});
}

TEST(WrongScene, TextThatIsNoTomlIsRefusedWithItsLine) {
  Attempt attempt("[scene\nframes = 3\n");
  expectRefusal(attempt, 2, {":1"});
}

TEST(WrongScene, AMillionCellsASideAreRefusedBeforeAnyAreMade) {
  Attempt attempt(replaced(smallSceneText(2), "cells = [16, 16, 16]", "cells = [1000000, 1000000, 1000000]"));
  expectRefusal(attempt, 2, {"gas.cells", "1000000"});
}

TEST(WrongScene, MoreCellsThanThisMachineHoldsAreRefusedAsNoRoom) {
  Attempt attempt(replaced(smallSceneText(2), "cells = [16, 16, 16]", "cells = [4096, 4096, 4096]"));
  expectRefusal(attempt, 4, {"memory", "GB"});
}

TEST(WrongScene, AMissingSceneIsNamed) {
  Attempt attempt("");
  fs::remove(attempt.scene);
  expectRefusal(attempt, 2, {"no such file"});
}

TEST(WrongScene, CheckTellsTheProblemToPeopleAndToScripts) {
  Attempt attempt(replaced(smallSceneText(2), "buoyancy", "bouyancy"));
  const Outcome outcome = runProgram({"check", attempt.scene, "--json"});
  expectOneLine(outcome, 2, {"buoyancy"});
  const nlohmann::json answer = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(answer["ok"], false);
  EXPECT_EQ(answer["problems"].size(), 1u);
  EXPECT_EQ(answer["problems"][0].get<std::string>() + "\n", outcome.err);
}

TEST(WrongCommandLine, EachMistakeIsOneLineAndExitCode2) {
  Attempt attempt(smallSceneText(2));
  const std::string scene = attempt.scene, run = attempt.run;
  expectOneLine(runProgram({}), 2, {"brisance:"});
  expectOneLine(runProgram({"explode"}), 2, {"explode", "unknown command", "simulate"});
  expectOneLine(runProgram({"run"}), 2, {"SCENE"});
  expectOneLine(runProgram({"simulate", scene}), 2, {"--output"});
  expectOneLine(runProgram({"run", scene, "--speed", "9"}), 2, {"--speed"});
  expectOneLine(runProgram({"run", scene, "--overwrite", "--resume"}), 2, {"--overwrite", "--resume"});
  expectOneLine(runProgram({"run", scene, "-o", run, "--threads", "-1"}), 2, {"--threads"});
  expectOneLine(runProgram({"run", scene, "-o", run, "--size", "64"}), 2, {"--size", "WIDTHxHEIGHT", "64"});
  expectOneLine(runProgram({"run", scene, "-o", run, "--samples", "0"}), 2, {"--samples"});
  for (const std::string& frames :
       std::vector<std::string>{"0-4", "4-2", "1-", "a", "1-2:0", "1-2:", "1-9999999999999", "-3", "1-2x"})
    expectOneLine(runProgram({"run", scene, "-o", run, std::string("--frames=").append(frames)}), 2,
                  {"--frames", frames});
  expectOneLine(runProgram({"run", scene, "-o", run, "--frames", "1-9"}), 2, {"--frames", "2 frames"});
  expectOneLine(runProgram({"simulate", scene, "-o", run, "--frames", "2-2"}), 2, {"begins at frame 1"});
  expectOneLine(runProgram({"run", scene, "-o", run, "--set", "gas.bouyancy=1"}), 2, {"bouyancy", "buoyancy"});
  expectOneLine(runProgram({"run", scene, "-o", run, "--set", "gas.buoyancy"}), 2, {"gas.buoyancy"});
  EXPECT_FALSE(fs::exists(run));
}

TEST(WrongCommandLine, WhatNeedsARunSaysSoWhereThereIsNone) {
  Attempt attempt(smallSceneText(2));
  fs::create_directory(attempt.run);
  for (const std::string& command : std::vector<std::string>{"render", "encode", "verify"})
    expectOneLine(runProgram({command, attempt.run}), 2, {attempt.run.string(), "run"});
  expectOneLine(runProgram({"info", attempt.place / "nothing"}), 2, {"does not exist"});
}

TEST(WrongCommandLine, ARunCannotBeRenderedWithAnotherSimulation) {
  Attempt attempt(smallSceneText(2));
  ASSERT_EQ(attempt.simulate({"--quiet"}).exitCode, 0);
  expectOneLine(runProgram({"render", attempt.run, "--set", "gas.buoyancy=1"}), 2, {"--set", "gas.buoyancy"});
  expectOneLine(runProgram({"render", attempt.run, "--frames", "7-9"}), 2, {"frame"});
}

}  // namespace
}  // namespace brisance::test
