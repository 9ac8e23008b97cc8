#include "frame/run_directory.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/check.h"
#include "frame/frame_samples.h"
#include "frame/gltf_export.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;
using Mode = RunDirectory::Mode;

/// A run of three frames.
void makeRun(const fs::path& path) {
  RunDirectory run(path, Mode::create);
  run.add("pieces.glb", piecesToGlb(sampleBodies()));
  for (int index = 1; index <= 3; ++index) run.addFrame(sampleFrame(index));
}

/// The message of the refusal; empty if there is none.
template <class Refusal>
std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Refusal& refusal) {
    EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos);
    return refusal.what();
  }
  return "";
}

std::string refusalToOpen(const fs::path& path, Mode mode) {
  return refusalOf<InputError>([&] { RunDirectory run(path, mode); });
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void damage(const fs::path& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(-3, std::ios::end);
  const int byte = file.get();
  file.seekp(-3, std::ios::end);
  file.put(static_cast<char>(byte ^ 0x55));
}

TEST(RunDirectory, AFrameReadsBackAsItWasWritten) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  const Frame written = sampleFrame(2), read = readFrame(scratch / "run", 2, true);
  EXPECT_EQ(read.index, 2);
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.gas, written.gas);
  EXPECT_EQ(read.particles, written.particles);
  EXPECT_EQ(read.report.heat.in, written.report.heat.in);
  ASSERT_EQ(read.bodies.size(), written.bodies.size());
  for (std::size_t n = 0; n < read.bodies.size(); ++n) {
    EXPECT_EQ(read.bodies[n].pose, written.bodies[n].pose);
    EXPECT_EQ(read.bodies[n].material, written.bodies[n].material);
    EXPECT_EQ(read.bodies[n].moves, written.bodies[n].moves);
    EXPECT_EQ(read.bodies[n].mesh->vertices, written.bodies[n].mesh->vertices);
  }
  EXPECT_TRUE(readFrame(scratch / "run", 2, false).gas.density.bricks.empty());
}

TEST(RunDirectory, ABodyHasTheShapeThatItLastTook) {
  const ScratchDirectory scratch;
  const Frame sample = sampleFrame(1);
  const auto scaled = [&](double factor) {
    TriangleMesh mesh = *sample.bodies[0].mesh;
    for (Vec3d& v : mesh.vertices) v *= factor;
    return std::make_shared<const TriangleMesh>(mesh);
  };
  {
    RunDirectory run(scratch / "run", Mode::create);
    run.add("pieces.glb", piecesToGlb(sample.bodies));
    for (int index = 1; index <= 4; ++index) {  // grows in the second and the third frame
      Frame frame = sampleFrame(index);
      if (index > 1) {
        frame.bodies[0].shapeFrame = std::min(index, 3);
        frame.bodies[0].mesh = scaled(frame.bodies[0].shapeFrame);
      }
      run.addFrame(frame);
    }
    EXPECT_FALSE(run.manifest().contains("bodies/shapes.0001.glb"));
    EXPECT_TRUE(run.manifest().contains("bodies/shapes.0003.glb"));
    EXPECT_FALSE(run.manifest().contains("bodies/shapes.0004.glb"));
  }
  EXPECT_EQ(verifyRun(scratch / "run"), std::vector<std::string>());
  const RunReader reader(scratch / "run");
  for (int index = 4; index >= 1; --index) {
    Frame frame;
    reader.readBodies(index, frame);
    EXPECT_EQ(frame.bodies[0].mesh->vertices, scaled(std::min(index, 3))->vertices) << index;
    EXPECT_EQ(frame.bodies[1].mesh->vertices, sample.bodies[1].mesh->vertices) << index;
    EXPECT_EQ(frame.bodies[0].material, sample.bodies[0].material);
  }
  RunDirectory(scratch / "run", Mode::overwrite);
  EXPECT_FALSE(fs::exists(scratch / "run/bodies"));  // its shapes were files of the run
}

TEST(RunDirectory, LiesAsPromised) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  for (const char* name : {"gas/gas.0003.vdb", "bodies/bodies.0003.json", "particles/particles.0003.ply",
                           "reports/report.0003.json", "pieces.glb", "manifest.json"})
    EXPECT_TRUE(fs::is_regular_file(scratch / "run" / name)) << name;
  EXPECT_EQ(RunDirectory(scratch / "run", Mode::open).lastFrame(), 3);
  EXPECT_EQ(verifyRun(scratch / "run"), std::vector<std::string>());
}

TEST(RunDirectory, EqualFramesHaveEqualContentsAndFiles) {
  const ScratchDirectory scratch;
  makeRun(scratch / "a");
  makeRun(scratch / "b");
  const auto a = readManifest(scratch / "a"), b = readManifest(scratch / "b");
  ASSERT_EQ(a.size(), 13u);
  for (const auto& [name, entry] : a) {
    EXPECT_EQ(b.at(name).content, entry.content);
    EXPECT_EQ(b.at(name).file.hash, entry.file.hash) << name;
  }
  EXPECT_NE(a.at("bodies/bodies.0001.json").content, a.at("bodies/bodies.0002.json").content);
}

TEST(RunDirectory, SeveralMayAddToItAtOnceAndLoseNothing) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  RunDirectory a(scratch / "run", Mode::share), b(scratch / "run", Mode::share);
  std::ofstream(scratch / "run/.tmp.1.frame.0001.png") << "b is writing";
  a.add("images/frame.0001.png", "one");
  b.add("images/frame.0002.png", "two");
  a.add("images/frame.0003.png", "three");
  b.inTurn([&] {
    EXPECT_TRUE(b.manifest().contains("images/frame.0003.png"));
    b.add("run.json", "{}");  // in the same turn
  });
  const RunDirectory c(scratch / "run", Mode::share);
  EXPECT_TRUE(fs::exists(scratch / "run/.tmp.1.frame.0001.png"));
  EXPECT_EQ(c.manifest().size(), 13u + 4u);
  EXPECT_TRUE(verifyRun(scratch / "run").empty());
}

TEST(RunDirectory, WhoSharesItAndWhoHasItAloneKeepEachOtherOut) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  const auto refusal = [&](Mode mode) { return refusalOf<Error>([&] { RunDirectory run(scratch / "run", mode); }); };
  {
    const RunDirectory shared(scratch / "run", Mode::share);
    for (const Mode mode : {Mode::open, Mode::resume, Mode::overwrite})
      EXPECT_TRUE(contains(refusal(mode), "another process is working in this run"));
    EXPECT_EQ(refusal(Mode::share), "");
  }
  {
    const RunDirectory alone(scratch / "run", Mode::open);
    EXPECT_TRUE(contains(refusal(Mode::share), "another process is working in this run"));
  }
  std::ofstream(scratch / "run/.tmp.1.left_by_a_killed_one") << "";
  const RunDirectory first(scratch / "run", Mode::share);
  EXPECT_FALSE(fs::exists(scratch / "run/.tmp.1.left_by_a_killed_one"));
}

TEST(RunDirectory, CreateRefusesARunAndNamesBothWaysOut) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  const std::string line = refusalToOpen(scratch / "run", Mode::create);
  EXPECT_TRUE(contains(line, (scratch / "run").string()));
  EXPECT_TRUE(contains(line, "--resume"));
  EXPECT_TRUE(contains(line, "--overwrite"));
  EXPECT_TRUE(verifyRun(scratch / "run").empty());
}

TEST(RunDirectory, NeverTouchesADirectoryThatHoldsSomethingElse) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "thesis.txt") << "mine";
  for (const Mode mode : {Mode::create, Mode::overwrite, Mode::resume, Mode::open})
    EXPECT_TRUE(contains(refusalToOpen(scratch.path(), mode), scratch.path().string()));
  EXPECT_EQ(scratch.count(), 1u);
  EXPECT_FALSE(refusalToOpen(scratch / "thesis.txt", Mode::overwrite).empty());
}

TEST(RunDirectory, ResumeAndOpenWantARun) {
  const ScratchDirectory scratch;
  EXPECT_TRUE(contains(refusalToOpen(scratch / "none", Mode::resume), "--resume"));
  EXPECT_FALSE(refusalToOpen(scratch / "none", Mode::open).empty());
  EXPECT_FALSE(fs::exists(scratch / "none"));
  EXPECT_FALSE(refusalOf<InputError>([&] { readManifest(scratch / "none"); }).empty());
}

TEST(RunDirectory, OverwriteRemovesWhatARunMadeAndNothingElse) {
  const ScratchDirectory scratch;
  const fs::path run = scratch / "run";
  makeRun(run);
  std::ofstream(run / "notes.txt") << "mine";
  std::ofstream(run / "gas" / "notes.txt") << "mine";
  std::ofstream(run / "gas" / "gas.0099.vdb") << "left by a killed run";
  {
    RunDirectory again(run, Mode::overwrite);
    EXPECT_TRUE(again.manifest().empty());
    EXPECT_EQ(again.lastFrame(), 0);
  }
  EXPECT_TRUE(fs::exists(run / "notes.txt"));
  EXPECT_TRUE(fs::exists(run / "gas" / "notes.txt"));
  EXPECT_FALSE(fs::exists(run / "gas" / "gas.0099.vdb"));
  EXPECT_FALSE(fs::exists(run / "gas" / "gas.0001.vdb"));
  EXPECT_FALSE(fs::exists(run / "pieces.glb"));
  EXPECT_FALSE(fs::exists(run / "bodies"));
}

TEST(RunDirectory, OverwriteBelievesNoManifestThatPointsOutside) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  std::ofstream(scratch / "victim") << "mine";
  std::ofstream(scratch / "run" / "manifest.json")
      << R"({"version": 1, "files": {"../victim": {"size": 4, "hash": "x"}}})";
  EXPECT_FALSE(refusalOf<DamagedFile>([&] { readManifest(scratch / "run"); }).empty());
  const RunDirectory run(scratch / "run", Mode::overwrite);
  EXPECT_TRUE(fs::exists(scratch / "victim"));
}

TEST(RunDirectory, ResumeKeepsWholeFramesAndMakesLostOnesAgain) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "run";
  makeRun(path);
  fs::resize_file(path / "gas" / "gas.0003.vdb", 10);
  std::ofstream(path / "gas" / ".tmp.1.gas.0004.vdb") << "half a file";
  std::ofstream(path / "bodies" / "bodies.0004.json") << "not in the manifest";
  RunDirectory run(path, Mode::resume);
  EXPECT_EQ(run.lastFrame(), 2);
  EXPECT_FALSE(fs::exists(path / "gas" / ".tmp.1.gas.0004.vdb"));
  run.addFrame(sampleFrame(3));
  run.addFrame(sampleFrame(4));
  EXPECT_EQ(run.lastFrame(), 4);
  EXPECT_TRUE(verifyRun(path).empty());
}

/// Writes frames until it is killed.
pid_t startEndlessRun(const fs::path& path) {
  const pid_t child = fork();
  if (child != 0) return child;
  RunDirectory run(path, Mode::create);
  run.add("pieces.glb", piecesToGlb(sampleBodies()));
  for (int index = 1;; ++index) run.addFrame(sampleFrame(index));
}

TEST(RunDirectory, ResumeDeletesACheckpointThatWasForgottenButNotDeleted) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "run";
  makeRun(path);
  RunDirectory(path, Mode::open).add("checkpoints/checkpoint.0002.bin", "known");
  std::ofstream(path / "checkpoints/checkpoint.0001.bin") << "forgotten";
  std::ofstream(path / "checkpoints/notes.txt") << "somebody's";
  RunDirectory(path, Mode::resume);
  EXPECT_TRUE(fs::exists(path / "checkpoints/checkpoint.0002.bin"));
  EXPECT_FALSE(fs::exists(path / "checkpoints/checkpoint.0001.bin"));
  EXPECT_TRUE(fs::exists(path / "checkpoints/notes.txt"));
}

TEST(RunDirectory, KilledAtAnyMomentItResumes) {
  for (int delay = 0; delay < 30; ++delay) {
    const ScratchDirectory scratch;
    const fs::path path = scratch / "run";
    const pid_t child = startEndlessRun(path);
    usleep(static_cast<useconds_t>(1500 * delay));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    // Killed before its first manifest, there is nothing to resume, and a new run may start.
    RunDirectory run(path, fs::exists(path / "manifest.json") ? Mode::resume : Mode::create);
    ASSERT_TRUE(verifyRun(path).empty());
    run.add("pieces.glb", piecesToGlb(sampleBodies()));
    const int next = run.lastFrame() + 1;
    run.addFrame(sampleFrame(next));
    ASSERT_EQ(readFrame(path, next, true).gas, sampleFrame(next).gas);
    ASSERT_TRUE(verifyRun(path).empty());
  }
}

TEST(RunDirectory, IsHeldByOneProcess) {
  const ScratchDirectory scratch;
  const RunDirectory run(scratch / "run", Mode::create);
  for (const Mode mode : {Mode::overwrite, Mode::resume, Mode::open}) try {
      RunDirectory second(scratch / "run", mode);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ExitCode::failed);
    }
}

TEST(RunDirectory, VerifyNamesDamagedMissingAndTruncatedFiles) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "run";
  makeRun(path);
  damage(path / "gas" / "gas.0001.vdb");
  fs::remove(path / "bodies" / "bodies.0002.json");
  fs::resize_file(path / "particles" / "particles.0003.ply", 100);
  const auto problems = verifyRun(path);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_TRUE(contains(problems[0], "bodies/bodies.0002.json: is missing"));
  EXPECT_TRUE(contains(problems[1], "gas/gas.0001.vdb: is damaged"));
  EXPECT_TRUE(contains(problems[2], "particles/particles.0003.ply: has 100 bytes"));
}

TEST(RunDirectory, VerifyNamesFramesWithGaps) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  RunDirectory run(scratch / "run", Mode::open);
  run.remove({"gas/gas.0002.vdb"});
  const auto problems = verifyRun(scratch / "run");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(contains(problems[0], "gas/gas.0002.vdb: is missing"));
  EXPECT_EQ(run.lastFrame(), 1);
}

TEST(RunDirectory, DamageIsFoundBeforeAParserSeesIt) {
  for (const char* name : {"gas/gas.0001.vdb", "bodies/bodies.0001.json", "particles/particles.0001.ply",
                           "reports/report.0001.json", "pieces.glb"}) {
    const ScratchDirectory scratch;
    makeRun(scratch / "run");
    damage(scratch / "run" / name);
    const std::string line = refusalOf<DamagedFile>([&] { readFrame(scratch / "run", 1, true); });
    EXPECT_TRUE(contains(line, (scratch / "run" / name).string())) << line;
  }
}

TEST(RunDirectory, ADamagedManifestIsNamed) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  fs::resize_file(scratch / "run" / "manifest.json", 50);
  const std::string line = refusalOf<DamagedFile>([&] { readFrame(scratch / "run", 1, false); });
  EXPECT_TRUE(contains(line, "manifest.json"));
  ASSERT_EQ(verifyRun(scratch / "run").size(), 1u);
}

TEST(RunDirectory, AFrameThatIsNotThereSaysWhichAre) {
  const ScratchDirectory scratch;
  makeRun(scratch / "run");
  const std::string line = refusalOf<InputError>([&] { readFrame(scratch / "run", 9, false); });
  EXPECT_TRUE(contains(line, "no frame 9"));
  EXPECT_TRUE(contains(line, "frames 1 to 3"));
}

TEST(RunDirectory, InputsAreKeptOncePerContent) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "cow.obj") << "v 0 0 0";
  std::ofstream(scratch / "same.obj") << "v 0 0 0";
  RunDirectory run(scratch / "run", Mode::create);
  const std::string name = run.addInput(scratch / "cow.obj");
  EXPECT_EQ(run.addInput(scratch / "same.obj"), name);
  EXPECT_EQ(name.find("inputs/"), 0u);
  EXPECT_EQ(fs::path(name).extension(), ".obj");
  EXPECT_EQ(readFile(scratch / "run" / name), "v 0 0 0");
  EXPECT_EQ(run.manifest().size(), 1u);
}

TEST(RunDirectory, FilesKeepNoNameOutsideTheRun) {
  const ScratchDirectory scratch;
  RunDirectory run(scratch / "run", Mode::create);
  for (const char* name : {"../a", "/tmp/a", "", "manifest.json", "gas/../../a", ".lock", "gas/"})
    EXPECT_THROW(run.add(name, "x"), std::logic_error) << name;
}

}  // namespace
}  // namespace brisance
