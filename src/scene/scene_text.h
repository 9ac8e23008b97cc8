// TOML as a tree that remembers where each value stood: what the reader reads and the writer writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace brisance {

/// A value of a TOML file.
struct SceneNode {
  enum class Kind { flag, integer, number, text, array, table, date };
  Kind kind = Kind::table;
  bool flag = false;
  std::int64_t integer = 0;
  double number = 0;
  bool singlePrecision = false;  ///< written with as many digits as a float needs
  std::string text;
  std::string key;                  ///< in the table that holds it
  std::vector<SceneNode> children;  ///< of an array or a table, in order
  std::string place;                ///< "FILE:LINE" or "--set"

  const SceneNode* find(const std::string& name) const;
  SceneNode* find(const std::string& name);
};

/// Text from elsewhere, fit for one line of a message: control characters replaced, cut after 60 characters.
std::string quoted(const std::string& text);
/// Several texts as one.
template <class Texts>
std::string joined(const Texts& texts, const char* between) {
  std::string out;
  for (const auto& text : texts) out.append(out.empty() ? "" : between).append(text);
  return out;
}
/// A value as it could stand in a file, in one line; long ones are cut.
std::string shownValue(const SceneNode& node);

/// Throws InputError "FILE:LINE: not TOML: ..." in one line, also for texts made to exhaust a parser.
SceneNode parseToml(const std::string& text, const std::string& fileName);

/// Puts one "key.path=value" into the tree. Throws InputError that begins with --set.
void applyOverride(SceneNode& root, const std::string& assignment);

/// Path of an element of an array of tables: its name where it has one, else its number from 0.
std::string elementName(const SceneNode& element, std::size_t index);
/// "bodies.pane.fracture.pieces", and with its number "bodies.0.fracture.pieces" -> "FILE:LINE", for every key of the
/// tree;
/// "" -> the file. Where two elements share a name, the name is the first one's.
std::map<std::string, std::string> placesOf(const SceneNode& root);

/// The tree as TOML.
std::string writeToml(const SceneNode& root);

}  // namespace brisance
