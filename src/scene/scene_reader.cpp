#include "scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"
#include "scene/scene_keys.h"

namespace brisance {
namespace {

using Kind = SceneNode::Kind;
constexpr double largestNumber = 1e15;     // beyond it a double no longer tells tenths apart
constexpr std::size_t longestText = 4096;  // bytes: as long as a path may be

/// Levenshtein's distance, one row at a time.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

std::string nearest(const std::string& name, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = 1 + std::max<std::size_t>(2, name.size() / 2);
  if (name.size() > longestText) return best;
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < least) least = distance, best = candidate;
  }
  return best;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = nearest(name, known);
  if (!near.empty()) return fmt::format("did you mean {}?", near);
  return fmt::format("must be one of {}", joined(known, ", "));
}

class Reader : public KeyVisitor {
 public:
  Reader(const SceneNode& root, std::filesystem::path directory, const GivenMeshes& given, double metresPerUnit)
      : directory_(std::move(directory)), given_(given), metresPerUnit_(metresPerUnit) {
    levels_.push_back({&root, "", {}, root.place});
  }

  void flag(const Key& key, bool& value) override {
    const SceneNode* node = take(key);
    if (node == nullptr) return;
    if (node->kind != Kind::flag) refuse(key, *node, "must be true or false");
    value = node->flag;
  }
  void integers(const Key& key, std::span<std::int64_t> values) override {
    readArray(key, values, [&](const SceneNode& node) { return integerOf(key, node); });
  }
  void numbers(const Key& key, std::span<double> values, Precision) override {
    const double scale = isLength(key) ? metresPerUnit_ : 1;
    readArray(key, values, [&](const SceneNode& node) { return numberOf(key, node) * scale; });
  }
  void places(const Key& key, std::vector<Vec2d>& values) override {
    const SceneNode* node = take(key);
    if (node == nullptr) return;
    const double scale = isLength(key) ? metresPerUnit_ : 1;
    if (node->kind != Kind::array) refuse(key, *node, "must be places [[x, y], ...]");
    values.clear();
    for (const SceneNode& place : node->children) {
      if (place.kind != Kind::array || place.children.size() != 2) refuse(key, place, "must be places [[x, y], ...]");
      values.push_back({numberOf(key, place.children[0]) * scale, numberOf(key, place.children[1]) * scale});
    }
  }
  void text(const Key& key, std::string& value) override {
    if (const SceneNode* node = take(key)) value = textOf(key, *node);
  }
  void file(const Key& key, std::filesystem::path& value) override {
    const SceneNode* node = take(key);
    if (node == nullptr) return;
    if (node->kind == Kind::text && given_.contains(node->text)) {
      value = node->text;
      return;
    }
    value = (directory_ / textOf(key, *node)).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(value, ignored))
      refuse(key, *node, fmt::format("must name a file, and there is none at {}", value.string()));
  }
  void choice(const Key& key, Names names, std::size_t& index) override {
    if (const SceneNode* node = take(key)) index = indexOf(key, *node, names);
  }
  bool wants(const Key& key, bool) override {
    levels_.back().known.push_back(key.name);
    return levels_.back().node->find(key.name) != nullptr;
  }

  void enter(const Key& key, bool typeAlone) override {
    const SceneNode* node = take(key);
    if (node != nullptr && node->kind != Kind::table && !(typeAlone && node->kind == Kind::text))
      refuse(key, *node, typeAlone ? "must be a type or a table with a type" : "must be a table");
    levels_.push_back({node == nullptr ? &nothing_ : node,
                       pathOf(key.name),
                       {},
                       node == nullptr ? place() : node->place,
                       *key.fallback != 0});
  }
  void leave() override {
    refuseUnknownKeys();
    levels_.pop_back();
  }
  std::size_t enterArray(const Key& key, std::size_t size) override {
    const SceneNode* node = take(key);
    if (node != nullptr && node->kind != Kind::array)
      refuse(key, *node, fmt::format("must be tables [[{}]]", pathOf(key.name)));
    levels_.push_back({node, pathOf(key.name), {}, node == nullptr ? place() : node->place});
    return node == nullptr ? size : node->children.size();
  }
  void enterElement(std::size_t index) override {
    const Level& array = levels_.back();
    if (array.node == nullptr) return levels_.push_back({&nothing_, array.path, {}, array.place});
    const SceneNode& element = array.node->children[index];
    const std::string path = fmt::format("{}.{}", array.path, quoted(elementName(element, index)));
    if (element.kind != Kind::table)
      throw InputError(fmt::format("{}: {}: must be a table, got {}", element.place, path, shownValue(element)));
    levels_.push_back({&element, path, {}, element.place});
  }
  void leaveElement() override { leave(); }
  void leaveArray() override { levels_.pop_back(); }

  std::vector<std::size_t> alternatives(Names names, std::size_t current) override {
    const Level& level = levels_.back();
    Key type{"type", "", anyValue, "which kind"};
    if (level.node->kind == Kind::text) return {indexOf(type, *level.node, names)};
    type.required = names.size() > 1 && level.node != &nothing_ && !level.typeMayMiss;
    if (const SceneNode* node = take(type)) return {indexOf(type, *node, names)};
    return {current};
  }

  void refuseUnknownKeys() const {
    const Level& level = levels_.back();
    for (const SceneNode& child : level.node->children)
      if (std::find(level.known.begin(), level.known.end(), child.key) == level.known.end())
        throw InputError(fmt::format("{}: {}: unknown key; {}", child.place, pathOf(quoted(child.key)),
                                     suggestion(child.key, level.known)));
  }

 private:
  /// A table that is being read.
  struct Level {
    const SceneNode* node;
    std::string path;
    std::vector<std::string> known;  ///< names asked for so far
    std::string place;
    bool typeMayMiss = false;  ///< the key says what holds then
  };

  std::string pathOf(const std::string& name) const {
    return levels_.back().path.empty() ? name : levels_.back().path + "." + name;
  }
  const std::string& place() const { return levels_.back().place; }

  /// The key's node, or null where it is not written. Notes the name as known.
  const SceneNode* take(const Key& key) {
    Level& level = levels_.back();
    level.known.push_back(key.name);
    const SceneNode* node = level.node->find(key.name);
    if (node == nullptr && key.required)
      throw InputError(fmt::format("{}: {}: is missing, must be given: {}", level.place, pathOf(key.name), key.doc));
    return node;
  }
  [[noreturn]] void refuse(const Key& key, const SceneNode& node, const std::string& what) const {
    throw InputError(
        fmt::format("{}: {}: {}{}, got {}", node.place, pathOf(key.name), what, unitOf(key), shownValue(node)));
  }
  std::string unitOf(const Key& key) const {
    if (*key.unit == 0) return "";
    return fmt::format(" [{}]", isLength(key) && metresPerUnit_ != 1 ? "scene units" : key.unit);
  }

  template <class T, class Read>
  void readArray(const Key& key, std::span<T> values, const Read& read) {
    const SceneNode* node = take(key);
    if (node == nullptr) return;
    if (values.size() == 1) {
      values[0] = read(*node);
      return;
    }
    if (node->kind != Kind::array || node->children.size() != values.size())
      refuse(key, *node, fmt::format("must be {} numbers in brackets", values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = read(node->children[i]);
  }
  double numberOf(const Key& key, const SceneNode& node) const {
    if (node.kind != Kind::number && node.kind != Kind::integer) refuse(key, node, "must be a number");
    if (!(std::abs(node.number) <= largestNumber))
      refuse(key, node, fmt::format("must be a number within {:g}", largestNumber));
    if (!key.range.contains(node.number)) refuse(key, node, "must be " + rangeText(key.range));
    return node.number;
  }
  std::int64_t integerOf(const Key& key, const SceneNode& node) const {
    if (node.kind != Kind::integer) refuse(key, node, "must be a whole number");
    if (!key.range.contains(static_cast<double>(node.integer))) refuse(key, node, "must be " + rangeText(key.range));
    return node.integer;
  }
  std::string textOf(const Key& key, const SceneNode& node) const {
    if (node.kind != Kind::text) refuse(key, node, "must be a text in quotes");
    const bool control = std::any_of(node.text.begin(), node.text.end(), [](unsigned char c) { return c < ' '; });
    if (node.text.empty() || node.text.size() > longestText || control)
      refuse(key, node, fmt::format("must be a text of 1 to {} bytes without control characters", longestText));
    return node.text;
  }
  std::size_t indexOf(const Key& key, const SceneNode& node, Names names) const {
    const auto found = std::find(names.begin(), names.end(), node.text);
    if (node.kind == Kind::text && found != names.end()) return static_cast<std::size_t>(found - names.begin());
    refuse(key, node, fmt::format("must be one of {}", joined(names, ", ")));
  }

  const SceneNode nothing_{};
  std::vector<Level> levels_;
  std::filesystem::path directory_;
  const GivenMeshes& given_;
  double metresPerUnit_;
};

void putMeshes(const GivenMeshes& given, SceneDraft& draft) {
  for (BodyKeys& keys : draft.bodies)
    if (auto* mesh = std::get_if<MeshShape>(&keys.body.shape))
      if (const auto found = given.find(mesh->file); found != given.end()) mesh->given = found->second;
}

}  // namespace

SceneDraft readDraft(const SceneNode& root, const std::filesystem::path& directory, const GivenMeshes& given) {
  SceneDraft first;  // the unit of length and the quality decide how the rest is read
  Reader general(root, directory, given, 1);
  visitTable(general, "scene", "", first, describeGeneral);
  SceneDraft draft;
  applyQuality(draft, first.quality);
  Reader reader(root, directory, given, first.metresPerUnit);
  describeScene(reader, draft);
  reader.refuseUnknownKeys();
  putMeshes(given, draft);
  return draft;
}

}  // namespace brisance
