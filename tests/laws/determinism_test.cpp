// Same scene, same seed, same results: for any number of threads and any vector width, however often a run was killed.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "program.h"

namespace brisance::test {
namespace {

using nlohmann::json;

constexpr int frames = 16;

/// Files whose bytes tell of the machine and the hour, by promise.
bool mayDiffer(const std::string& name) {
  return name == "run.json" || name == "manifest.json" || name == "film.mp4" || name == ".lock" ||
         name.starts_with("reports/");
}

/// All files of a run that promise to be the same for the same scene.
std::map<std::string, std::string> bytesOf(const fs::path& run) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = fs::relative(entry.path(), run).generic_string();
    if (entry.is_regular_file() && !mayDiffer(name)) bytes[name] = textOf(entry.path());
  }
  return bytes;
}

/// The manifest's content hashes.
std::map<std::string, std::string> contentsOf(const fs::path& run) {
  std::map<std::string, std::string> contents;
  const json manifest = json::parse(textOf(run / "manifest.json"));
  for (const auto& [name, entry] : manifest.at("files").items())
    if (entry.contains("content")) contents[name] = entry["content"];
  return contents;
}

void expectSameRun(const fs::path& one, const fs::path& other) {
  const auto a = bytesOf(one), b = bytesOf(other);
  for (const auto& [name, bytes] : a) EXPECT_TRUE(b.contains(name) && b.at(name) == bytes) << name << " differs";
  EXPECT_EQ(a.size(), b.size());
  EXPECT_GE(contentsOf(one).size(), 3u * frames) << "gas, bodies and particles of each frame";
  EXPECT_EQ(contentsOf(one), contentsOf(other));
}

/// A scene file and one undisturbed run of it, shared by the tests of this file.
class Determinism : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = std::make_unique<ScratchDirectory>();
    writeText(scene(), smallSceneText(frames));
    const auto start = std::chrono::steady_clock::now();
    undisturbed_ = runProgram({"simulate", scene(), "-o", calm(), "--quiet"});
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  static void TearDownTestSuite() { place_.reset(); }
  void SetUp() override { ASSERT_EQ(undisturbed_.exitCode, 0) << undisturbed_.err; }

  static fs::path scene() { return *place_ / "small.toml"; }
  static fs::path calm() { return *place_ / "calm"; }
  /// A run that differs from the undisturbed one in how it is made.
  static Outcome simulate(const std::string& name, const std::vector<std::string>& extra,
                          const StartOptions& options = {}) {
    std::vector<std::string> arguments{"simulate", scene(), "-o", *place_ / name, "--quiet"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return runProgram(arguments, options);
  }

  static inline std::unique_ptr<ScratchDirectory> place_;
  static inline Outcome undisturbed_;
  static inline double seconds_ = 0;
};

TEST_F(Determinism, OneThreadGivesTheSameFilesAsTwo) {
  ASSERT_EQ(simulate("one", {"--threads", "1"}).exitCode, 0);
  ASSERT_EQ(simulate("two", {"--threads", "2"}).exitCode, 0);
  expectSameRun(*place_ / "one", *place_ / "two");
  expectSameRun(*place_ / "one", calm());
}

TEST_F(Determinism, PlainCodeGivesTheSameFilesAsTheWidestVectors) {
  for (const std::string& path : std::vector<std::string>{"plain", "avx2"}) {
    StartOptions options;
    options.environment = {{"BRISANCE_VECTOR", path}};
    ASSERT_EQ(simulate(path, {}, options).exitCode, 0);
    expectSameRun(*place_ / path, calm());
  }
}

TEST_F(Determinism, EverySchemeGivesTheSameFilesByOnePlainThreadAsByTwoWideOnes) {
  for (const std::string& scheme : std::vector<std::string>{"maccormack", "semi_lagrangian"}) {
    const std::vector<std::string> carried{"--set", "gas.advection=" + scheme, "--set", "gas.viscosity=0.01"};
    std::vector<std::string> one = carried, two = carried;
    one.insert(one.end(), {"--threads", "1"});
    two.insert(two.end(), {"--threads", "2"});
    StartOptions plain;
    plain.environment = {{"BRISANCE_VECTOR", "plain"}};
    ASSERT_EQ(simulate(scheme + "_one", one, plain).exitCode, 0);
    ASSERT_EQ(simulate(scheme + "_two", two).exitCode, 0);
    expectSameRun(*place_ / (scheme + "_one"), *place_ / (scheme + "_two"));
    EXPECT_NE(contentsOf(*place_ / (scheme + "_one")), contentsOf(calm()));
  }
}

TEST_F(Determinism, AnotherSeedGivesAnotherExplosion) {
  ASSERT_EQ(simulate("seed", {"--set", "scene.seed=8"}).exitCode, 0);
  EXPECT_NE(contentsOf(*place_ / "seed"), contentsOf(calm()));
}

TEST_F(Determinism, KilledTenTimesAndResumedIsTheSameAsNeverKilled) {
  const fs::path run = *place_ / "killed";
  const Random random(1, Stream::test);
  for (std::uint64_t kill = 0; kill < 10; ++kill) {
    Program program({"simulate", scene(), "-o", run, "--quiet", "--resume"});
    usleep(static_cast<useconds_t>(random.uniform(kill) * seconds_ * 1e6));
    program.send(SIGKILL);
    const Outcome outcome = program.wait();
    EXPECT_TRUE(outcome.exitCode == 128 + SIGKILL || outcome.exitCode == 0) << outcome.err;
  }
  const Outcome last = simulate("killed", {"--resume"});
  ASSERT_EQ(last.exitCode, 0) << last.err;
  expectSameRun(run, calm());
  EXPECT_TRUE(temporariesIn(run).empty());
  EXPECT_EQ(runProgram({"verify", run}).exitCode, 0);
}

TEST_F(Determinism, ARunExtendedByFramesIsTheSameAsALongOne) {
  ASSERT_EQ(simulate("extended", {"--frames", "1-5"}).exitCode, 0);
  EXPECT_FALSE(fs::exists(*place_ / "extended/gas/gas.0006.vdb"));
  ASSERT_EQ(simulate("extended", {"--resume"}).exitCode, 0);
  expectSameRun(*place_ / "extended", calm());
}

TEST_F(Determinism, AFinishedRunThatIsResumedStaysAsItWas) {
  ASSERT_EQ(simulate("again", {}).exitCode, 0);
  ASSERT_EQ(simulate("again", {"--resume"}).exitCode, 0);
  expectSameRun(*place_ / "again", calm());
}

}  // namespace
}  // namespace brisance::test
