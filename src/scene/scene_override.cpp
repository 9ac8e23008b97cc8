// --set key.path=value
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "scene/scene_text.h"

namespace brisance {
namespace {

constexpr std::size_t longestOverride = 4096;  // characters; bounds how deep a path can go

std::vector<std::string> splitPath(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// The value as TOML; a word that is no TOML value stands for its text.
SceneNode parseValue(const std::string& path, const std::string& text) {
  try {
    SceneNode root = parseToml("value = " + text + "\n", "--set");
    if (root.children.size() == 1) return root.children.front();
  } catch (const InputError&) {
    if (text.find_first_of("[]{}\"'=\n") != std::string::npos)
      throw InputError(
          fmt::format("--set: {}: must be a TOML value or a plain word, got {}", quoted(path), quoted(text)));
  }
  SceneNode word;
  word.kind = SceneNode::Kind::text;
  word.text = text;
  return word;
}

[[noreturn]] void refuseElement(const SceneNode& array, const std::string& part, const std::string& path) {
  std::vector<std::string> names;
  names.reserve(array.children.size());
  for (std::size_t i = 0; i < array.children.size(); ++i) names.push_back(elementName(array.children[i], i));
  throw InputError(fmt::format("--set: {}: there is no {}; there {}", quoted(path), quoted(part),
                               names.empty() ? "are none" : fmt::format("are {}", quoted(joined(names, ", ")))));
}

SceneNode& elementOf(SceneNode& array, const std::string& part, const std::string& path) {
  for (std::size_t i = 0; i < array.children.size(); ++i)
    if (elementName(array.children[i], i) == part || fmt::format("{}", i) == part) return array.children[i];
  refuseElement(array, part, path);
}

/// A type given as its name alone becomes a table with that type, so that keys can be added to it.
void makeTable(SceneNode& node) {
  if (node.kind != SceneNode::Kind::text) return;
  SceneNode type = node;
  type.key = "type";
  node.kind = SceneNode::Kind::table;
  node.children = {type};
}

SceneNode& childOf(SceneNode& node, const std::string& part, const std::string& path) {
  if (node.kind == SceneNode::Kind::array) return elementOf(node, part, path);
  makeTable(node);
  if (node.kind != SceneNode::Kind::table)
    throw InputError(fmt::format("--set: {}: {} stands inside a value that is no table", quoted(path), quoted(part)));
  if (SceneNode* child = node.find(part)) return *child;
  SceneNode fresh;
  fresh.key = part;
  fresh.place = "--set";
  node.children.push_back(fresh);
  return node.children.back();
}

void setPlace(SceneNode& node) {
  node.place = "--set";
  for (SceneNode& child : node.children) setPlace(child);
}

}  // namespace

void applyOverride(SceneNode& root, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || assignment.size() > longestOverride)
    throw InputError(fmt::format("--set: must be key.path=value, got {}", quoted(assignment)));
  const std::string path = assignment.substr(0, equals);
  SceneNode value = parseValue(path, assignment.substr(equals + 1));
  SceneNode* node = &root;
  for (const std::string& part : splitPath(path)) {
    if (part.empty()) throw InputError(fmt::format("--set: {}: must be names joined by dots", quoted(path)));
    node = &childOf(*node, part, path);
  }
  value.key = node->key;
  setPlace(value);
  *node = value;
}

}  // namespace brisance
