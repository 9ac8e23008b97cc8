// Places where nothing can be written: one line, exit code 4, and nothing half-written.
#include <grp.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

constexpr uid_t nobody = 65534;

/// Becomes an ordinary user, whom permissions bind.
void dropRights() {
  if (getuid() != 0) return;
  if (setgroups(0, nullptr) != 0 || setgid(nobody) != 0 || setuid(nobody) != 0) _exit(126);
}

/// A copy of the program and a scene that everyone may read, wherever the build tree lies.
struct PublicPlace {
  PublicPlace() {
    fs::permissions(place.path(), fs::perms::all);
    fs::copy_file(BRISANCE_BINARY, binary);
    fs::permissions(binary, fs::perms(0755));
    writeText(scene, smallSceneText(4));
  }
  ScratchDirectory place;
  fs::path binary = place / "brisance", scene = place / "small.toml";
};

TEST(NoRoom, ADirectoryThatMayNotBeWrittenIsNamed) {
  PublicPlace p;
  const fs::path closed = p.place / "closed";
  fs::create_directory(closed);
  fs::permissions(closed, fs::perms(0555));
  StartOptions options;
  options.binary = p.binary;
  options.beforeStart = dropRights;
  const Outcome outcome = runProgram({"simulate", p.scene, "-o", closed / "run"}, options);
  expectOneLine(outcome, 4, {(closed / "run").string()});
  EXPECT_TRUE(fs::is_empty(closed));
}

TEST(NoRoom, ARunThatBelongsToSomeoneElseIsLeftAlone) {
  if (getuid() != 0) GTEST_SKIP() << "needs another user's files, which only root can make";
  PublicPlace p;
  const fs::path run = p.place / "run";
  ASSERT_EQ(runProgram({"simulate", p.scene, "-o", run, "--frames", "1-2", "--quiet"}).exitCode, 0);
  StartOptions options;
  options.binary = p.binary;
  options.beforeStart = dropRights;
  const Outcome outcome = runProgram({"simulate", p.scene, "-o", run, "--overwrite", "--quiet"}, options);
  expectOneLine(outcome, 4, {run.string()});
  expectInOrder(run);
}

/// A disk of a few hundred kilobytes, as long as the test lives. Mounted in a namespace of our own, which children
/// share.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& size) : works_(enterNamespace() && mountAt(place_.path(), size)) {}
  ~SmallDisk() {
    if (works_) umount2(place_.path().c_str(), MNT_DETACH);
  }
  bool works() const { return works_; }
  fs::path operator/(const std::string& name) const { return place_ / name; }

 private:
  static bool enterNamespace() {
    if (getuid() == 0)
      return unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    const std::string user = std::to_string(getuid()), group = std::to_string(getgid());
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    writeText("/proc/self/setgroups", "deny");
    writeText("/proc/self/uid_map", user + " " + user + " 1");
    writeText("/proc/self/gid_map", group + " " + group + " 1");
    return true;
  }
  static bool mountAt(const fs::path& place, const std::string& size) {
    return mount("tmpfs", place.c_str(), "tmpfs", 0, ("size=" + size + ",mode=0777").c_str()) == 0;
  }

  ScratchDirectory place_;
  bool works_;
};

TEST(NoRoom, AFullDiskStopsASimulationWithAWholeRunBehind) {
  PublicPlace p;
  for (const std::string& size : std::vector<std::string>{"16k", "100k", "200k"}) {
    SmallDisk disk(size);
    if (!disk.works()) GTEST_SKIP() << "no right to mount a small disk here";
    const fs::path run = disk / "run";
    const Outcome outcome = runProgram({"simulate", p.scene, "-o", run, "--quiet"});
    expectOneLine(outcome, 4, {run.string(), "No space left on device"});
    expectInOrder(run);
  }
}

/// Kibibytes that a directory's files take in whole pages.
std::uintmax_t kibibytesOf(const fs::path& directory) {
  constexpr std::uintmax_t page = 4096;
  std::uintmax_t pages = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    pages += entry.is_regular_file() ? (entry.file_size() + page - 1) / page : 1;
  return pages * page / 1024;
}

TEST(NoRoom, AFullDiskStopsPicturesWithAWholeRunBehind) {
  PublicPlace p;
  const fs::path made = p.place / "made";
  ASSERT_EQ(runProgram({"simulate", p.scene, "-o", made, "--quiet"}).exitCode, 0);
  constexpr int spare = 32;  // [KiB] for the first pictures, not for all
  SmallDisk disk(std::to_string(kibibytesOf(made) + spare) + "k");
  if (!disk.works()) GTEST_SKIP() << "no right to mount a small disk here";
  const fs::path run = disk / "run";
  fs::copy(made, run, fs::copy_options::recursive);
  const Outcome outcome = runProgram({"render", run, "--size", "640x480", "--quiet"});
  expectOneLine(outcome, 4, {run.string(), "No space left on device"});
  expectInOrder(run);
}

TEST(NoRoom, ARunThatStoppedForRoomGoesOnWhenThereIsSome) {
  PublicPlace p;
  const fs::path kept = p.place / "kept";
  {
    SmallDisk disk("200k");
    if (!disk.works()) GTEST_SKIP() << "no right to mount a small disk here";
    EXPECT_EQ(runProgram({"simulate", p.scene, "-o", disk / "run", "--quiet"}).exitCode, 4);
    fs::copy(disk / "run", kept, fs::copy_options::recursive);
  }
  const Outcome resumed = runProgram({"simulate", p.scene, "-o", kept, "--resume", "--quiet"});
  EXPECT_EQ(resumed.exitCode, 0) << resumed.err;
  expectInOrder(kept);
}

}  // namespace
}  // namespace brisance::test
