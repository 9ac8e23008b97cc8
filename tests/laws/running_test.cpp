// One run, one writer; and an interruption that leaves it in order.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace brisance::test {
namespace {

constexpr int many = 2000;  // frames: far more than are made before a test interrupts

struct LongRun {
  LongRun() { writeText(scene, smallSceneText(many)); }
  bool hasFrames(int count) const {
    char name[32];
    std::snprintf(name, sizeof name, "reports/report.%04d.json", count);
    return fs::exists(run / name);
  }
  ScratchDirectory place;
  fs::path scene = place / "long.toml", run = place / "run";
};

constexpr double patience = 60;  // [s] on a machine that is busy with other tests

void expectInterruptedBy(int signal, int exitCode) {
  LongRun l;
  Program program({"simulate", l.scene, "-o", l.run});
  ASSERT_TRUE(waitUntil([&] { return l.hasFrames(3); }, patience));
  program.send(signal);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted; continue with: " BRISANCE_BINARY " simulate " + l.scene.string()),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("--resume"), std::string::npos);
  EXPECT_EQ(runProgram({"verify", l.run}).exitCode, 0);
  EXPECT_TRUE(temporariesIn(l.run).empty());

  const Outcome resumed = runProgram({"simulate", l.scene, "-o", l.run, "--resume", "--frames", "1-6", "--quiet"});
  EXPECT_EQ(resumed.exitCode, 0) << resumed.err;
}

TEST(Interruption, CtrlCLeavesAResumableRunAndExitCode130) { expectInterruptedBy(SIGINT, 130); }
TEST(Interruption, SigtermLeavesAResumableRunAndExitCode143) { expectInterruptedBy(SIGTERM, 143); }

TEST(Interruption, APictureThatIsBeingMadeIsFinishedAndTheRestLeft) {
  LongRun l;
  const std::string frames = "1-40";
  ASSERT_EQ(runProgram({"simulate", l.scene, "-o", l.run, "--frames", frames, "--quiet"}).exitCode, 0);
  Program program({"render", l.run, "--size", "320x240", "--samples", "4"});
  ASSERT_TRUE(waitUntil([&] { return fs::exists(l.run / "images/frame.0001.png"); }, patience));
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("--skip-existing"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(l.run / "images/frame.0040.png"));
  EXPECT_EQ(runProgram({"verify", l.run}).exitCode, 0);
}

TEST(RunDirectories, ASecondWriterIsRefusedWhileTheFirstLives) {
  LongRun l;
  Program first({"simulate", l.scene, "-o", l.run, "--quiet"});
  ASSERT_TRUE(waitUntil([&] { return l.hasFrames(2); }, patience));
  for (const std::string& option : std::vector<std::string>{"--resume", "--overwrite"}) {
    const Outcome second = runProgram({"simulate", l.scene, "-o", l.run, option});
    EXPECT_EQ(second.exitCode, 1) << second.err;
    EXPECT_NE(second.err.find("another process is working in this run"), std::string::npos) << second.err;
  }
  EXPECT_TRUE(first.isAlive());
}

TEST(RunDirectories, ARunThatExistsIsNeitherOverwrittenNorContinuedUnasked) {
  LongRun l;
  ASSERT_EQ(runProgram({"simulate", l.scene, "-o", l.run, "--frames", "1-2", "--quiet"}).exitCode, 0);
  const std::string before = textOf(l.run / "manifest.json");
  const Outcome refused = runProgram({"simulate", l.scene, "-o", l.run});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  EXPECT_EQ(textOf(l.run / "manifest.json"), before);
}

TEST(RunDirectories, AnotherSceneCannotResumeARun) {
  LongRun l;
  ASSERT_EQ(runProgram({"simulate", l.scene, "-o", l.run, "--frames", "1-2", "--quiet"}).exitCode, 0);
  const Outcome refused =
      runProgram({"simulate", l.scene, "-o", l.run, "--resume", "--set", "explosion.burn_rate=0.002"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("explosion.burn_rate differs"), std::string::npos) << refused.err;
}

TEST(RunDirectories, AFilmIsMadeStageByStageAsInOneGo) {
  LongRun l;
  const fs::path inOneGo = l.place / "whole";
  ASSERT_EQ(runProgram({"simulate", l.scene, "-o", l.run, "--frames", "1-4", "--quiet"}).exitCode, 0);
  ASSERT_EQ(runProgram({"render", l.run, "--frames", "3-4", "--quiet"}).exitCode, 0);
  ASSERT_EQ(runProgram({"render", l.run, "--skip-existing", "--quiet"}).exitCode, 0);
  ASSERT_EQ(runProgram({"render", l.run, "--overwrite", "--frames", "4", "--quiet"}).exitCode, 0);
  EXPECT_EQ(runProgram({"render", l.run, "--overwrite", "--skip-existing", "--quiet"}).exitCode, 2);
  ASSERT_EQ(runProgram({"encode", l.run, "--quiet"}).exitCode, 0);
  const Outcome whole = runProgram({"run", l.scene, "-o", inOneGo, "--frames", "1-4", "--quiet"});
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  for (const std::string& name :
       std::vector<std::string>{"images/frame.0001.png", "images/frame.0004.png", "images/frame.0004.exr"})
    EXPECT_TRUE(textOf(l.run / name) == textOf(inOneGo / name)) << name;
  EXPECT_EQ(runProgram({"verify", l.run}).exitCode, 0);
  EXPECT_TRUE(fs::exists(l.run / "film.mp4"));
}

TEST(RunDirectories, FramesFromTheMiddleArePicturesWithoutAFilm) {
  LongRun l;
  const Outcome outcome = runProgram({"run", l.scene, "-o", l.run, "--frames", "2-4:2", "--quiet"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(l.run / "gas/gas.0004.vdb"));
  for (const int frame : {1, 2, 3, 4})
    EXPECT_EQ(fs::exists(l.run / ("images/frame.000" + std::to_string(frame) + ".png")), frame % 2 == 0) << frame;
  EXPECT_FALSE(fs::exists(l.run / "film.mp4"));
}

TEST(Json, ARunPrintsTheContentOfItsRunJsonAndNothingElse) {
  LongRun l;
  const Outcome outcome = runProgram({"run", l.scene, "-o", l.run, "--frames", "1-2", "--json", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out), nlohmann::json::parse(textOf(l.run / "run.json")));
  EXPECT_EQ(outcome.err, "");
}

// Fuel that the gas hardly heats is not lit by what burns beside it.
TEST(Json, ARunSaysThatItsFireWentOut) {
  LongRun l;
  const auto account = [&](const char* heating) {
    const std::string asked = std::string("explosion.heating=") + heating;
    const Outcome outcome =
        runProgram({"simulate", l.scene, "-o", l.run, "--overwrite", "--frames", "1-12", "--set", asked});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return std::pair(nlohmann::json::parse(textOf(l.run / "run.json"))["fire_went_out"].get<bool>(),
                     outcome.out.find("fire      went out: ") != std::string::npos);
  };
  EXPECT_EQ(account("75000"), std::pair(false, false));
  EXPECT_EQ(account("1"), std::pair(true, true));
}

TEST(Json, ARunGivesAnAccountOfItself) {
  LongRun l;
  const Outcome outcome =
      runProgram({"simulate", l.scene, "-o", l.run, "--frames", "1-4", "--threads", "1", "--json", "--quiet"});
  const nlohmann::json account = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(account["frames"], 4);
  EXPECT_EQ(account["seed"], 7);
  EXPECT_EQ(account["threads"], 1);
  EXPECT_GT(account["peak_memory_mb"], 1);
  EXPECT_GT(account["seconds"]["simulate"]["total"], 0);
  EXPECT_GT(account["balances"]["volume"]["in"], 0);
  // What left is summed from single-precision velocities on the faces: about 1e-7 each; solved to 1e-6.
  EXPECT_LT(account["balances"]["volume"]["error"], 1e-5);
  EXPECT_LT(account["balances"]["heat"]["error"], 1e-4);
  EXPECT_LE(account["courant"], 1.0);
}

}  // namespace
}  // namespace brisance::test
