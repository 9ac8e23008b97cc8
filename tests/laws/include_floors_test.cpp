// The house of docs/architecture.md as a test: who may include whom, and where the heavy headers live.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  ///< "fluid/pressure.cpp", relative to src/, or "apps/cli/main.cpp"
  int line = 0;
  std::string included;  ///< between the quotes or brackets
  bool quoted = false;
};

const std::map<std::string, int>& floorOf() {
  static const std::map<std::string, int> table{
      {"base", 0},  {"grid", 1},       {"mesh", 1},   {"fluid", 2}, {"particles", 2}, {"rigid", 2}, {"fracture", 2},
      {"frame", 2}, {"simulation", 3}, {"render", 3}, {"scene", 4}, {"view", 4},      {"apps", 5}};
  return table;
}

/// A heavy header and how its includes begin.
const std::vector<std::string>& heavyHeaders() {
  static const std::vector<std::string> starts{"openvdb/", "embree3/", "boost/polygon", "toml++/", "OpenEXR/", "Imf"};
  return starts;
}

std::string folderOf(const std::string& file) { return file.substr(0, file.find('/')); }

std::vector<Include> includesOfText(const std::string& file, std::istream& text) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  std::vector<Include> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) found.push_back({file, number, match[2], match[1] == "\""});
  }
  return found;
}

void addIncludesUnder(const fs::path& root, const std::string& prefix, std::vector<Include>& all) {
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream text(entry.path());
    const std::string name = prefix + fs::relative(entry.path(), root).generic_string();
    for (const Include& include : includesOfText(name, text)) all.push_back(include);
  }
}

std::vector<Include> includesOfTheHouse() {
  const fs::path root = BRISANCE_SOURCE_DIR;
  std::vector<Include> all;
  addIncludesUnder(root / "src", "", all);
  addIncludesUnder(root / "apps", "apps/", all);
  return all;
}

/// Why the edge is wrong; nothing where it is right.
std::optional<std::string> troubleWith(const Include& include) {
  if (!include.quoted) return std::nullopt;
  const std::string from = folderOf(include.file), to = folderOf(include.included);
  // A file of apps/ names its neighbours without their folder: "progress_bar.h".
  if (from == "apps" && include.included.find('/') == std::string::npos) return std::nullopt;
  if (!floorOf().contains(from)) return "lies in a folder that the table of floors does not know";
  if (!floorOf().contains(to)) return "includes a folder that the table of floors does not know";
  if (from == to || floorOf().at(to) < floorOf().at(from)) return std::nullopt;
  return floorOf().at(to) == floorOf().at(from) ? "includes a neighbour on its own floor" : "includes a floor above";
}

std::string asLine(const Include& include, const std::string& trouble) {
  return include.file + ":" + std::to_string(include.line) + ": " + trouble + ": " + include.included;
}

std::optional<std::string> troubleWithText(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  return troubleWith(includesOfText(file, stream).at(0));
}

TEST(IncludeFloors, EveryFileIncludesOnlyItsOwnFolderAndLowerFloors) {
  const std::vector<Include> all = includesOfTheHouse();
  ASSERT_GT(all.size(), 100u) << "the sources were not found";
  for (const Include& include : all)
    if (const auto trouble = troubleWith(include)) ADD_FAILURE() << asLine(include, *trouble);
}

TEST(IncludeFloors, AMadeUpWrongEdgeIsFound) {
  EXPECT_EQ(troubleWithText("fluid/a.cpp", "#include \"rigid/rigid_step.h\""), "includes a neighbour on its own floor");
  EXPECT_EQ(troubleWithText("base/a.h", "  #  include \"grid/grid3.h\""), "includes a floor above");
  EXPECT_EQ(troubleWithText("attic/a.h", "#include \"base/math.h\""),
            "lies in a folder that the table of floors does not know");
  EXPECT_EQ(troubleWithText("fluid/a.h", "#include \"attic/math.h\""),
            "includes a folder that the table of floors does not know");
  EXPECT_EQ(troubleWithText("fluid/a.h", "#include \"apps/cli/main.h\""), "includes a floor above");
}

TEST(IncludeFloors, ARightEdgePasses) {
  EXPECT_FALSE(troubleWithText("scene/a.cpp", "#include \"base/math.h\""));
  EXPECT_FALSE(troubleWithText("fluid/a.cpp", "#include \"fluid/pressure.h\""));
  EXPECT_FALSE(troubleWithText("apps/cli/a.cpp", "#include \"scene/scene_file.h\""));
  EXPECT_FALSE(troubleWithText("apps/cli/a.cpp", "#include \"progress_bar.h\""));
  EXPECT_FALSE(troubleWithText("fluid/a.cpp", "#include <vector>"));
}

TEST(IncludeFloors, EveryFloorOfTheTableIsAFolderAndTheOtherWayRound) {
  const fs::path root = fs::path(BRISANCE_SOURCE_DIR) / "src";
  for (const auto& [folder, floor] : floorOf())
    EXPECT_TRUE(folder == "apps" || fs::is_directory(root / folder)) << folder;
  for (const auto& entry : fs::directory_iterator(root))
    EXPECT_TRUE(floorOf().contains(entry.path().filename().string())) << entry.path();
}

/// Grids and points are two formats of OpenVDB's, and their headers too much for one file.
std::size_t filesOf(const std::string& heavyHeader) { return heavyHeader == "openvdb/" ? 2 : 1; }

TEST(HeavyHeaders, EachStaysInItsSourceFileAndInNoHeader) {
  const std::vector<Include> all = includesOfTheHouse();
  for (const std::string& start : heavyHeaders()) {
    std::map<std::string, int> files;
    for (const Include& include : all)
      if (include.included.starts_with(start)) ++files[include.file];
    EXPECT_LE(files.size(), filesOf(start))
        << start << " is included by " << files.begin()->first << " and " << files.rbegin()->first;
    for (const auto& [file, count] : files)
      EXPECT_TRUE(file.ends_with(".cpp")) << file << " is a header and includes " << start;
  }
}

}  // namespace
