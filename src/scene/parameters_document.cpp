#include <fmt/format.h>

#include "scene/key_catalogue.h"
#include "scene/reference.h"
#include "scene/scene_keys.h"

namespace brisance {
namespace {

using Type = CatalogueEntry::Type;

/// A key with its full path, as the document lists it.
struct Row {
  std::string path;  ///< "bodies[].shape.width"
  std::string only;  ///< "pane": a key of that type alone
  const CatalogueEntry* entry;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void collect(const CatalogueEntry& table, const std::string& prefix, const std::string& only, std::vector<Row>& rows);

void collectAll(const std::vector<CatalogueEntry>& keys, const std::string& prefix, const std::string& only,
                std::vector<Row>& rows) {
  for (const CatalogueEntry& entry : keys) {
    const std::string path = prefix + entry.key.name;
    if (entry.type == Type::table || entry.type == Type::array)
      collect(entry, path + (entry.type == Type::array ? "[]." : "."), only, rows);
    else
      rows.push_back({path, only, &entry});
  }
}

void collect(const CatalogueEntry& table, const std::string& prefix, const std::string& only, std::vector<Row>& rows) {
  if (!table.names.empty()) rows.push_back({prefix + "type", only, &table});
  collectAll(table.children, prefix, only, rows);
  for (std::size_t i = 0; i < table.alternatives.size(); ++i)
    collectAll(table.alternatives[i], prefix, table.names[i], rows);
}

std::string defaultText(const CatalogueEntry& entry) {
  if (entry.key.required) return "required";
  if (entry.optional) return escaped(entry.key.fallback);
  return fmt::format("`{}`", shownValue(entry.value));
}

std::string typeText(const CatalogueEntry& entry) {
  switch (entry.type) {
    case Type::flag:
      return "true or false";
    case Type::integer:
      return entry.count == 1 ? "whole number" : fmt::format("{} whole numbers", entry.count);
    case Type::number:
      return entry.count == 1 ? "number" : fmt::format("{} numbers", entry.count);
    case Type::places:
      return "places `[[x, y], ...]`";
    case Type::text:
      return "text";
    case Type::file:
      return "file";
    default:
      return fmt::format("`{}`", joined(entry.names, "`, `"));
  }
}

std::string valuesText(const CatalogueEntry& entry) {
  const std::string range = rangeText(entry.key.range);
  return typeText(entry) + (range.empty() ? "" : ", " + range);
}

/// A type of a table is declared with the table, so it has no sentence or unit of its own.
std::string meaning(const Row& row) {
  const std::string only = row.only.empty() ? "" : fmt::format("({}) ", row.only);
  return escaped(only + (row.entry->type == Type::array ? "which kind" : row.entry->key.doc));
}

std::string symbolTable(const std::vector<Row>& rows) {
  std::string out = "| symbol | tables | key, or where it lives | unit | default |\n|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const Symbol& symbol = row.entry->key.symbol;
    if (*symbol.name != 0)
      out += fmt::format("| {} | {} | `{}` | {} | {} |\n", symbol.name, symbol.tables, row.path, row.entry->key.unit,
                         defaultText(*row.entry));
  }
  for (const ThesisVariable& variable : thesisVariables())
    out += fmt::format("| {} | {} | {} | | |\n", variable.symbol.name, variable.symbol.tables, variable.variable);
  return out;
}

std::string keyTable(const CatalogueEntry& table) {
  std::vector<Row> rows;
  collect(table, table.key.name + std::string(table.type == Type::array ? "[]." : "."), "", rows);
  std::string out = "| key | values | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const Row& row : rows)
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.path, valuesText(*row.entry), row.entry->key.unit,
                       defaultText(*row.entry), meaning(row));
  return out;
}

constexpr const char* introduction = R"(# The scene file, key by key

Generated from the declarations that the reader uses; a test compares it with them.

Lengths, that is keys in m, count in scene units of `scene.metres_per_unit` metres; their defaults are in metres.
Every other unit is SI. Times are simulated seconds but for `camera.keys[].time`, which is seconds of film.
`name[]` is an array of tables, `[[name]]` in the file; `--set` reaches its elements by name or by number from 0:
`--set bodies.pane.fracture.pieces=32`. A table with a `type` may be given as the name of the type alone:
`pressure = "fast_poisson"`.

`scene.quality` changes these defaults, and nothing else:

)";

std::string presetTable() {
  std::string out =
      "| quality | `render.width` | `render.height` | `render.samples` | `gas.resolution` | "
      "`render.volume.resolution` |\n|---|---|---|---|---|---|\n";
  constexpr std::pair<const char*, Quality> presets[] = {
      {"none", Quality::none}, {"draft", Quality::draft}, {"final", Quality::final}};
  for (const auto& [name, quality] : presets) {
    SceneDraft draft;
    applyQuality(draft, quality);
    const RenderSettings& render = draft.scene.render;
    out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", name, render.width, render.height, render.samples,
                       draft.gasResolution, draft.volumeResolution);
  }
  return out;
}

}  // namespace

std::string parametersDocument() {
  const CatalogueEntry root = catalogueOfKeys();
  std::vector<Row> rows;
  collectAll(root.children, "", "", rows);
  std::string out = introduction + presetTable();
  out += "\n## Symbols of the thesis\n\nFrom its Tables 2.1, 2.2, 3.1, 5.1 and 5.3.\n\n" + symbolTable(rows);
  for (const CatalogueEntry& table : root.children)
    out += fmt::format("\n## {}\n\n{}.\n\n{}", table.key.name, escaped(table.key.doc), keyTable(table));
  return out;
}

}  // namespace brisance
