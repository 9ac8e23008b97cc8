#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"

namespace brisance {
namespace {

constexpr std::size_t longestShown = 60;  // characters of a value in a message

bool isBareKey(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

std::string escapedText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

/// Shortest text that reads back as the same number.
std::string numberText(const SceneNode& node) {
  std::string text =
      node.singlePrecision ? fmt::format("{}", static_cast<float>(node.number)) : fmt::format("{}", node.number);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string inlineText(const SceneNode& node, int depth = 0) {
  constexpr int deepest = 4;  // for messages; what is written out is flatter than this
  if (depth > deepest) return "...";
  std::vector<std::string> parts;
  switch (node.kind) {
    case SceneNode::Kind::flag:
      return node.flag ? "true" : "false";
    case SceneNode::Kind::integer:
      return fmt::format("{}", node.integer);
    case SceneNode::Kind::number:
      return numberText(node);
    case SceneNode::Kind::text:
      return escapedText(node.text);
    case SceneNode::Kind::date:
      return "a date or time";
    case SceneNode::Kind::array:
      for (const SceneNode& child : node.children) parts.push_back(inlineText(child, depth + 1));
      return fmt::format("[{}]", joined(parts, ", "));
    case SceneNode::Kind::table:
      for (const SceneNode& child : node.children)
        parts.push_back(fmt::format("{} = {}", quoted(child.key), inlineText(child, depth + 1)));
      return fmt::format("{{ {} }}", joined(parts, ", "));
  }
  return "";
}

bool isTableArray(const SceneNode& node) {
  return node.kind == SceneNode::Kind::array && !node.children.empty() &&
         node.children.front().kind == SceneNode::Kind::table;
}

void writeTable(const SceneNode& table, const std::string& path, std::string& out) {
  for (const SceneNode& child : table.children)
    if (child.kind != SceneNode::Kind::table && !isTableArray(child))
      out += fmt::format("{} = {}\n", child.key, inlineText(child));
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const SceneNode& child : table.children) {
    if (child.kind == SceneNode::Kind::table) {
      out += fmt::format("\n[{}{}]\n", prefix, child.key);
      writeTable(child, prefix + child.key, out);
    }
    if (!isTableArray(child)) continue;
    for (const SceneNode& element : child.children) {
      out += fmt::format("\n[[{}{}]]\n", prefix, child.key);
      writeTable(element, prefix + child.key, out);
    }
  }
}

void collectPlaces(const SceneNode& node, const std::string& path, std::map<std::string, std::string>& places) {
  places.emplace(path, node.place);
  const std::string prefix = path.empty() ? "" : path + ".";
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const SceneNode& child = node.children[i];
    if (node.kind == SceneNode::Kind::table) collectPlaces(child, prefix + child.key, places);
    if (node.kind != SceneNode::Kind::array || child.kind != SceneNode::Kind::table) continue;
    const std::string number = fmt::format("{}", i), name = elementName(child, i);
    collectPlaces(child, prefix + number, places);
    if (name != number) collectPlaces(child, prefix + name, places);
  }
}

}  // namespace

const SceneNode* SceneNode::find(const std::string& name) const {
  const auto found = std::find_if(children.begin(), children.end(), [&](const SceneNode& c) { return c.key == name; });
  return found == children.end() ? nullptr : &*found;
}

SceneNode* SceneNode::find(const std::string& name) {
  return const_cast<SceneNode*>(static_cast<const SceneNode*>(this)->find(name));
}

std::string quoted(const std::string& text) {
  std::string out = text.substr(0, longestShown);
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  while (text.size() > longestShown && !out.empty() && (out.back() & 0x80) != 0) out.pop_back();  // no half characters
  return text.size() > longestShown ? out + "..." : out;
}

std::string shownValue(const SceneNode& node) { return quoted(inlineText(node)); }

std::string elementName(const SceneNode& element, std::size_t index) {
  const SceneNode* name = element.kind == SceneNode::Kind::table ? element.find("name") : nullptr;
  const bool named = name != nullptr && name->kind == SceneNode::Kind::text && isBareKey(name->text);
  return named ? name->text : fmt::format("{}", index);
}

std::map<std::string, std::string> placesOf(const SceneNode& root) {
  std::map<std::string, std::string> places;
  collectPlaces(root, "", places);
  return places;
}

std::string writeToml(const SceneNode& root) {
  std::string out;
  writeTable(root, "", out);
  return out.substr(out.find_first_not_of('\n') == std::string::npos ? 0 : out.find_first_not_of('\n'));
}

}  // namespace brisance
