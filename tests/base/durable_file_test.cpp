#include "base/durable_file.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/check.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;

constexpr int skipped = 77;  // exit code of a child that could not make its surroundings

/// Runs `body` in a process of its own and returns its exit code; -1 when it was killed.
int inChild(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// 0 when `action` throws an Error of `code` in one line that names `name`.
int expectError(ExitCode code, const std::string& name, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    const std::string line = error.what();
    return error.code == code && line.find(name) != line.npos && line.find('\n') == line.npos ? 0 : 2;
  }
  return 1;
}

TEST(ContentHash, IsTheKnownXxh3OfNothingAndOfAText) {
  EXPECT_EQ(ContentHash().hex(), "99aa06d3014798d86001c324468d497f");  // the reference value for an empty input
  ContentHash whole, parts;
  whole.add("an exploding scene");
  parts.add("an explod");
  parts.add("ing scene");
  EXPECT_EQ(whole.hex(), parts.hex());
  EXPECT_NE(whole.hex(), ContentHash().hex());
}

TEST(WriteDurably, LeavesTheBytesTheirRecordAndNothingElse) {
  const ScratchDirectory scratch;
  const std::string bytes(3000000, 'x');
  const FileRecord record = writeDurably(scratch / "a.bin", bytes);
  EXPECT_EQ(readFile(scratch / "a.bin"), bytes);
  EXPECT_EQ(record.size, bytes.size());
  EXPECT_EQ(record.hash, recordOf(scratch / "a.bin").hash);
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(WriteDurably, ReplacesAFileAsAWhole) {
  const ScratchDirectory scratch;
  writeDurably(scratch / "a", "a long old text");
  writeDurably(scratch / "a", [](std::ostream& out) { out << "new " << 7; });
  EXPECT_EQ(readFile(scratch / "a"), "new 7");
}

TEST(WriteDurably, KeepsTheOldFileWhenTheWriterFails) {
  const ScratchDirectory scratch;
  writeDurably(scratch / "a", "old");
  const auto failing = [](std::ostream& out) {
    out << "half";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(writeDurably(scratch / "a", failing), std::runtime_error);
  EXPECT_EQ(readFile(scratch / "a"), "old");
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(WriteDurably, SaysWhichDirectoryIsNotThere) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "none" / "a";
  EXPECT_EQ(expectError(ExitCode::noRoom, path.string(), [&] { writeDurably(path, "x"); }), 0);
}

/// Writes too much in several ways onto a disk of one megabyte.
int fillTheDisk(const fs::path& disk) {
  const std::string tooMuch(4 << 20, 'x');
  writeDurably(disk / "old", "old");
  const auto bySteps = [&](std::ostream& out) {
    for (std::size_t n = 0; n < tooMuch.size(); ++n) out.put(tooMuch[n]);
  };
  const auto byName = [&](const fs::path& temporary) { std::ofstream(temporary) << tooMuch; };
  const std::string name = (disk / "old").string();
  const int failures = expectError(ExitCode::noRoom, name, [&] { writeDurably(disk / "old", tooMuch); }) +
                       expectError(ExitCode::noRoom, name, [&] { writeDurably(disk / "old", bySteps); }) +
                       expectError(ExitCode::noRoom, name, [&] { writeDurablyByName(disk / "old", byName); });
  const auto entries = std::distance(fs::directory_iterator(disk), {});
  return failures + (readFile(disk / "old") != "old") + (entries != 1);
}

TEST(WriteDurably, RefusesAFullDiskInOneLineAndKeepsTheOldFile) {
  const ScratchDirectory scratch;
  const int result = inChild([&] {
    const bool mounted = unshare(CLONE_NEWNS | (geteuid() == 0 ? 0 : CLONE_NEWUSER)) == 0 &&
                         mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         mount("tmpfs", scratch.path().c_str(), "tmpfs", 0, "size=1m") == 0;
    return mounted ? fillTheDisk(scratch.path()) : skipped;
  });
  if (result == skipped) GTEST_SKIP() << "this system does not let a test mount a small disk";
  EXPECT_EQ(result, 0);
}

TEST(WriteDurably, RefusesAFileThatGrowsBeyondItsLimit) {
  const ScratchDirectory scratch;
  const int result = inChild([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 20, 1 << 20};
    setrlimit(RLIMIT_FSIZE, &limit);
    const fs::path path = scratch / "a";
    return expectError(ExitCode::noRoom, path.string(), [&] { writeDurably(path, std::string(4 << 20, 'x')); });
  });
  EXPECT_EQ(result, 0);
  EXPECT_EQ(scratch.count(), 0u);
}

TEST(WriteDurably, RefusesADirectoryThatMayNotBeWritten) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "a";
  chmod(scratch.path().c_str(), 0555);
  const int result = inChild([&] {
    constexpr uid_t nobody = 65534;
    if (geteuid() == 0 && setuid(nobody) != 0) return skipped;
    return expectError(ExitCode::noRoom, path.string(), [&] { writeDurably(path, "x"); }) +
           expectError(ExitCode::noRoom, path.string(), [&] { makeDirectories(path / "deeper"); }) +
           expectError(ExitCode::noRoom, scratch.path().string(), [&] { DirectoryLock lock(scratch.path()); });
  });
  chmod(scratch.path().c_str(), 0755);
  if (result == skipped) GTEST_SKIP() << "cannot become an unprivileged user";
  EXPECT_EQ(result, 0);
  EXPECT_EQ(scratch.count(), 0u);
}

TEST(WriteDurablyByName, KeepsTheExtensionForLibrariesThatLookAtIt) {
  const ScratchDirectory scratch;
  const FileRecord record = writeDurablyByName(scratch / "a.png", [](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".png");
    std::ofstream(temporary) << "picture";
  });
  EXPECT_EQ(readFile(scratch / "a.png"), "picture");
  EXPECT_EQ(record.size, 7u);
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(WriteDurably, KilledHalfwayLeavesOnlyATemporaryThatCanBeRemoved) {
  const ScratchDirectory scratch;
  const int result = inChild([&] {
    writeDurably(scratch / "a", [](std::ostream& out) {
      out << std::string(1 << 20, 'x');
      raise(SIGKILL);
    });
    return 0;
  });
  EXPECT_EQ(result, -1);
  EXPECT_FALSE(fs::exists(scratch / "a"));
  EXPECT_EQ(scratch.count(), 1u);
  removeTemporaries(scratch.path());
  EXPECT_EQ(scratch.count(), 0u);
}

TEST(RemoveTemporaries, LeavesEverythingElseAlone) {
  const ScratchDirectory scratch;
  for (const char* name : {"a.tmp", ".hidden", "tmp.1.a"}) std::ofstream(scratch / name) << "mine";
  removeTemporaries(scratch.path());
  removeTemporaries(scratch / "not there");
  EXPECT_EQ(scratch.count(), 3u);
}

TEST(ReadFile, SaysWhichFileCannotBeRead) {
  const ScratchDirectory scratch;
  const std::string name = (scratch / "none").string();
  EXPECT_EQ(expectError(ExitCode::badInput, name, [&] { readFile(scratch / "none"); }), 0);
  EXPECT_EQ(expectError(ExitCode::badInput, scratch.path().string(), [&] { readFile(scratch.path()); }), 0);
}

TEST(DirectoryLock, IsHeldByOneAtATimeAndReleasedAtTheEnd) {
  const ScratchDirectory scratch;
  const auto lockIt = [&] { DirectoryLock lock(scratch.path()); };
  {
    const DirectoryLock lock(scratch.path());
    EXPECT_EQ(expectError(ExitCode::failed, scratch.path().string(), lockIt), 0);
    EXPECT_EQ(inChild([&] { return expectError(ExitCode::failed, scratch.path().string(), lockIt); }), 0);
  }
  EXPECT_NO_THROW(lockIt());
}

TEST(DirectoryLock, IsReleasedWhenItsHolderIsKilled) {
  const ScratchDirectory scratch;
  const int result = inChild([&] {
    const DirectoryLock lock(scratch.path());
    return raise(SIGKILL);
  });
  EXPECT_EQ(result, -1);
  EXPECT_NO_THROW(DirectoryLock lock(scratch.path()));
}

}  // namespace
}  // namespace brisance
