#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "base/check.h"
#include "scene/scene_text.h"

namespace brisance {
namespace {

constexpr std::size_t largestFile = 16u << 20;  // bytes; the largest scenes people write by hand hold a few hundred kB
constexpr int longestKey = 32;   // parts; bounds how deeply tables can nest, and so the stack to walk them
constexpr int deepestNode = 64;  // a scene has no use for more than a few

SceneNode convert(const toml::node& node, const std::string& fileName, int depth);

/// toml++ sorts keys by name; people read, and expect to be told of mistakes, in the order of the file.
void convertTable(const toml::table& table, SceneNode& out, const std::string& fileName, int depth) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, value] : table) entries.emplace_back(&key, &value);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first->source().begin < b.first->source().begin; });
  for (const auto& [key, value] : entries) {
    out.children.push_back(convert(*value, fileName, depth + 1));
    out.children.back().key = std::string(key->str());
    out.children.back().place = fmt::format("{}:{}", fileName, key->source().begin.line);
  }
}

SceneNode::Kind kindOf(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return SceneNode::Kind::table;
    case toml::node_type::array:
      return SceneNode::Kind::array;
    case toml::node_type::string:
      return SceneNode::Kind::text;
    case toml::node_type::integer:
      return SceneNode::Kind::integer;
    case toml::node_type::floating_point:
      return SceneNode::Kind::number;
    case toml::node_type::boolean:
      return SceneNode::Kind::flag;
    default:
      return SceneNode::Kind::date;
  }
}

SceneNode convert(const toml::node& node, const std::string& fileName, int depth) {
  if (depth > deepestNode)
    throw InputError(
        fmt::format("{}:{}: must nest at most {} tables and arrays", fileName, node.source().begin.line, deepestNode));
  SceneNode out;
  out.kind = kindOf(node);
  out.place = fmt::format("{}:{}", fileName, node.source().begin.line);
  if (const auto* table = node.as_table()) convertTable(*table, out, fileName, depth);
  if (const auto* array = node.as_array())
    for (const toml::node& element : *array) out.children.push_back(convert(element, fileName, depth + 1));
  if (const auto* text = node.as_string()) out.text = text->get();
  if (const auto* number = node.as_floating_point()) out.number = number->get();
  if (const auto* flag = node.as_boolean()) out.flag = flag->get();
  if (const auto* integer = node.as_integer()) {
    out.integer = integer->get();
    out.number = static_cast<double>(out.integer);
  }
  return out;
}

/// Refuses keys of very many parts before the parser sees them: each part becomes a nested table.
void refuseLongKeys(const std::string& text, const std::string& fileName) {
  int line = 1, parts = 1;
  bool afterDot = true;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == ']' || c == '{' || c == '}') parts = 1;
    if (c == '.' && !afterDot && ++parts > longestKey)
      throw InputError(
          fmt::format("{}:{}: not TOML that a scene needs: a key of more than {} parts", fileName, line, longestKey));
    if (c != ' ' && c != '\t') afterDot = c == '.';
  }
}

void refuseStrangeBytes(const std::string& text, const std::string& fileName) {
  if (text.size() > largestFile)
    throw InputError(fmt::format("{}: must be at most {} bytes, has {}", fileName, largestFile, text.size()));
  const std::size_t zero = text.find('\0');
  if (zero != std::string::npos)
    throw InputError(fmt::format("{}:{}: not TOML: must be text, holds a zero byte", fileName,
                                 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n')));
}

}  // namespace

SceneNode parseToml(const std::string& text, const std::string& fileName) {
  refuseStrangeBytes(text, fileName);
  refuseLongKeys(text, fileName);
  try {
    SceneNode root = convert(toml::parse(text), fileName, 0);
    root.place = fileName;
    return root;
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace_if(
        what.begin(), what.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, ' ');
    throw InputError(fmt::format("{}:{}: not TOML: {}", fileName, error.source().begin.line, what));
  }
}

}  // namespace brisance
