#include "base/durable_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/check.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;

TEST(DurableFolder, IsSeenOnlyWhenItIsWhole) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "out";
  DurableFolder folder(path);
  folder.add("a", "one");
  EXPECT_FALSE(fs::exists(path));
  folder.add("b", "two");
  folder.finish();
  EXPECT_EQ(readFile(path / "a") + readFile(path / "b"), "onetwo");
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(DurableFolder, LeavesNothingBehindWhereItIsGivenUp) {
  const ScratchDirectory scratch;
  { DurableFolder(scratch / "out").add("a", "one"); }
  EXPECT_EQ(scratch.count(), 0u);
}

TEST(DurableFolder, TakesTheOldOnesPlaceWhole) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "out";
  fs::create_directory(path);
  std::ofstream(path / "old") << "old";
  DurableFolder folder(path / "");  // with a slash behind it, it is the same folder
  folder.add("new", "new");
  EXPECT_TRUE(fs::exists(path / "old"));
  folder.finish();
  EXPECT_TRUE(fs::exists(path / "new"));
  EXPECT_FALSE(fs::exists(path / "old"));
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(DurableFolder, TellsTroubleWithTheFinalName) {
  const ScratchDirectory scratch;
  try {
    DurableFolder folder(scratch / "none/out");
    FAIL();
  } catch (const Error& trouble) {
    EXPECT_EQ(trouble.code, ExitCode::noRoom);
    EXPECT_TRUE(std::string(trouble.what()).starts_with((scratch / "none/out").string()));
  }
  try {
    DurableFolder(scratch / "out").add("none/a", "one");
    FAIL();
  } catch (const Error& trouble) {
    EXPECT_TRUE(std::string(trouble.what()).starts_with((scratch / "out/none/a").string())) << trouble.what();
  }
}

}  // namespace
}  // namespace brisance
