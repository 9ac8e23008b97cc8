// The schema and the documents say what the reader does.
#include "scene/reference.h"

#include <nlohmann/json.hpp>
#include <set>

#include "base/durable_file.h"
#include "scene/key_catalogue.h"
#include "scene/scene_keys.h"
#include "scene_fixture.h"

namespace brisance {
namespace {

using Json = nlohmann::json;

TEST(Reference, TheCommittedDocumentIsTheGeneratedOne) {
  EXPECT_EQ(readFile(std::filesystem::path(BRISANCE_SOURCE_DIR) / "docs/parameters.md"), parametersDocument());
}

/// Of each table of the thesis, its symbols as the errata name them.
const std::map<std::string, std::vector<std::string>> thesisTables = {
    {"2.1", {"pos", "vel", "m", "Y", "c_m", "r", "s", "T_i"}},
    {"2.2", {"c_k", "c_r", "g_x, g_y, g_z", "H", "p", "Re", "t", "T", "T_a", "T_max", "u", "v", "w"}},
    {"3.1", {"pos (body)", "vel (body)", "m (body)", "alpha (body)", "omega", "I", "n_v", "verts"}},
    {"5.1", {"alpha",      "min_d",      "max_d",    "n_f",      "tau",      "alpha_d", "alpha_h", "b_h",
             "b_g",        "b_s",        "c_m",      "c_k",      "c_r",      "F_c",     "m",       "n_p",
             "n_r",        "nx, ny, nz", "r_d",      "T_a",      "T_i",      "T_max",   "z_f",     "z_s",
             "vx, vy, vz", "pos_det",    "thres_mf", "thres_ms", "thres_cm", "c_soot",  "np_i",    "np_it"}}};

void collectSymbols(const std::vector<CatalogueEntry>& entries, std::set<std::string>& found) {
  for (const CatalogueEntry& entry : entries) {
    found.insert(std::string(entry.key.symbol.name) + "@" + entry.key.symbol.tables);
    collectSymbols(entry.children, found);
    for (const auto& keys : entry.alternatives) collectSymbols(keys, found);
  }
}

TEST(Reference, EverySymbolOfTheThesisHasAKeyOrAVariable) {
  std::set<std::string> found;
  collectSymbols(catalogueOfKeys().children, found);
  for (const ThesisVariable& variable : thesisVariables())
    found.insert(std::string(variable.symbol.name) + "@" + variable.symbol.tables);
  const auto has = [&](const std::string& symbol, const std::string& table) {
    for (const std::string& entry : found)
      if (entry.starts_with(symbol + "@") && entry.find(table, symbol.size()) != std::string::npos) return true;
    return false;
  };
  for (const auto& [table, symbols] : thesisTables)
    for (const std::string& symbol : symbols) EXPECT_TRUE(has(symbol, table)) << symbol << " of table " << table;
  for (const std::string& symbol : thesisTables.at("5.1")) EXPECT_TRUE(has(symbol, "5.3")) << symbol << " of table 5.3";
}

/// Whether a schema knows a property anywhere along a path.
bool knows(const Json& schema, const std::vector<std::string>& path, std::size_t at = 0) {
  if (at == path.size()) return true;
  if (schema.contains("items")) return knows(schema["items"], path, at);
  if (schema.contains("anyOf")) {
    for (const Json& kind : schema["anyOf"])
      if (knows(kind, path, at)) return true;
    return false;
  }
  return schema.contains("properties") && schema["properties"].contains(path[at]) &&
         knows(schema["properties"][path[at]], path, at + 1);
}

void expectKnown(const Json& schema, const std::vector<CatalogueEntry>& entries,
                 const std::vector<std::string>& prefix) {
  for (const CatalogueEntry& entry : entries) {
    std::vector<std::string> path = prefix;
    path.emplace_back(entry.key.name);
    EXPECT_TRUE(knows(schema, path)) << joined(path, ".");
    expectKnown(schema, entry.children, path);
    for (const auto& keys : entry.alternatives) expectKnown(schema, keys, path);
  }
}

TEST(Reference, TheSchemaIsJsonAndKnowsEveryKey) {
  const Json schema = Json::parse(sceneSchema());
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["additionalProperties"], false);
  expectKnown(schema, catalogueOfKeys().children, {});
  EXPECT_EQ(schema["properties"]["explosion"]["properties"]["burn_rate"]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(schema["properties"]["gas"]["properties"]["pressure"]["anyOf"].size(), 5u)
      << "a table for each type, or the name of the type";
  EXPECT_EQ(schema["properties"]["bodies"]["items"]["required"], Json({"name", "shape"}));
  EXPECT_EQ(schema["properties"]["render"]["properties"]["background"]["default"], Json({0.5, 0.6, 0.7}));
}

/// The keys of a tree, as paths without the numbers of elements.
void collectPaths(const SceneNode& node, const std::string& path, std::set<std::string>& paths) {
  for (const SceneNode& child : node.children) {
    const std::string inner = child.key.empty() ? path : path + "." + child.key;
    if (!child.key.empty()) paths.insert(inner);
    collectPaths(child, inner, paths);
  }
}

TEST(Reference, EveryKeyThatIsWrittenStandsInTheDocument) {
  const std::string document = parametersDocument();
  std::set<std::string> paths;
  collectPaths(parseToml(writeScene(parseScene("", "s.toml")), "s.toml"), "", paths);
  EXPECT_GT(paths.size(), 80u);
  for (const std::string& path : paths) {
    if (path.find(".materials") == 0) continue;  // an array of tables: its keys carry brackets there
    EXPECT_NE(document.find(path.substr(1)), std::string::npos) << path;
  }
}

TEST(Reference, EveryKeyHasASentence) {
  const auto check = [](const auto& self, const std::vector<CatalogueEntry>& entries) -> void {
    for (const CatalogueEntry& entry : entries) {
      EXPECT_GT(std::string(entry.key.doc).size(), 3u) << entry.key.name;
      if (entry.optional) {
        EXPECT_NE(std::string(entry.key.fallback), "") << entry.key.name;
      }
      self(self, entry.children);
      for (const auto& keys : entry.alternatives) self(self, keys);
    }
  };
  check(check, catalogueOfKeys().children);
}

}  // namespace
}  // namespace brisance
