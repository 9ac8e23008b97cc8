// Small readers of exported files, of their own making: what they find is not what the writers think.
#pragma once

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace brisance::test {

/// A binary glTF taken apart.
class Glb {
 public:
  explicit Glb(const std::string& bytes) : bytes_(bytes) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    json = nlohmann::json::parse(bytes.substr(20, length));
    binary_ = 20 + length + 8;
  }

  /// The numbers of an accessor, one row per element.
  std::vector<std::vector<float>> floats(std::size_t accessor) const {
    static const std::map<std::string, std::size_t> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const auto& entry = json.at("accessors").at(accessor);
    if (entry.at("componentType") != 5126) throw std::runtime_error("no floats");
    const std::size_t width = widths.at(entry.at("type"));
    const char* from = bytes_.data() + binary_ + viewOf(accessor).at("byteOffset").get<std::size_t>();
    std::vector<std::vector<float>> rows(entry.at("count"), std::vector<float>(width));
    for (auto& row : rows) {
      std::memcpy(row.data(), from, width * sizeof(float));
      from += width * sizeof(float);
    }
    return rows;
  }

  const nlohmann::json& viewOf(std::size_t accessor) const {
    return json.at("bufferViews").at(json.at("accessors").at(accessor).at("bufferView").get<std::size_t>());
  }
  std::string bytesOf(const nlohmann::json& view) const {
    return bytes_.substr(binary_ + view.at("byteOffset").get<std::size_t>(), view.at("byteLength"));
  }

  int node(const std::string& name) const {
    for (std::size_t n = 0; n < json.at("nodes").size(); ++n)
      if (json.at("nodes")[n].at("name") == name) return static_cast<int>(n);
    throw std::runtime_error("no node " + name);
  }

  struct Track {
    std::vector<double> seconds;
    std::vector<std::vector<float>> values;
  };
  /// Empty: the node has no such track.
  Track track(const std::string& name, const std::string& path) const {
    if (!json.contains("animations")) return {};
    const auto& animation = json.at("animations").at(0);
    for (const auto& channel : animation.at("channels")) {
      if (channel.at("target").at("node") != node(name) || channel.at("target").at("path") != path) continue;
      const auto& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
      if (sampler.at("interpolation") != "LINEAR") throw std::runtime_error("not linear");
      Track track{{}, floats(sampler.at("output"))};
      for (const auto& row : floats(sampler.at("input"))) track.seconds.push_back(row[0]);
      return track;
    }
    return {};
  }

  /// A node's value at a time, as a player finds it: between keys a straight line, outside the nearest key. (Turning on
  /// the arc instead of the line matters only between keys.)
  std::vector<double> at(const std::string& name, const std::string& path, double seconds) const {
    const Track track = this->track(name, path);
    if (track.seconds.empty()) return json.at("nodes").at(node(name)).at(path).get<std::vector<double>>();
    std::size_t next = 0;
    while (next < track.seconds.size() && track.seconds[next] < seconds) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, track.seconds.size() - 1);
    const double span = track.seconds[after] - track.seconds[before];
    const double share = span > 0 ? (seconds - track.seconds[before]) / span : 0;
    std::vector<double> value;
    for (std::size_t c = 0; c < track.values[0].size(); ++c)
      value.push_back(track.values[before][c] + share * (track.values[after][c] - track.values[before][c]));
    return value;
  }

  nlohmann::json json;

 private:
  std::string bytes_;
  std::size_t binary_ = 0;
};

/// One prim of a USD text layer: its lines as they stand, and the prims inside.
struct UsdPrim {
  std::string type, name, metadata;
  std::map<std::string, std::string> properties;                  ///< "point3f[] points": "[(0, 0, 0), ...]"
  std::map<std::string, std::map<int, std::string>> timeSamples;  ///< by property and time code
  std::vector<UsdPrim> children;

  const UsdPrim& child(const std::string& wanted) const {
    for (const UsdPrim& prim : children)
      if (prim.name == wanted) return prim;
    throw std::runtime_error("no prim " + wanted + " in " + name);
  }
  /// "/World/Bodies" from the layer's root; null: not there.
  const UsdPrim* at(const std::string& path) const {
    if (path.empty()) return this;
    const std::size_t end = std::min(path.find('/', 1), path.size());
    for (const UsdPrim& prim : children)
      if (prim.name == path.substr(1, end - 1)) return prim.at(path.substr(end));
    return nullptr;
  }
};

/// Reads the part of USD's text grammar that our layers use, character by character; throws std::runtime_error where
/// the text does not follow it.
class UsdReader {
 public:
  explicit UsdReader(const std::string& text) : text_(text) {}

  UsdPrim layer() {
    if (!text_.starts_with("#usda 1.0\n")) fail("no usda");
    at_ = text_.find('\n');
    UsdPrim root;
    if (peek() == '(') root.metadata = balanced();
    while (peek() != '\0') root.children.push_back(prim());
    return root;
  }

 private:
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  [[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + " before: " + text_.substr(at_, 60));
  }
  void expect(char c) {
    if (peek() != c) fail(std::string("no ") + c);
    ++at_;
  }
  std::string word() {
    peek();
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || strchr("_:.[]", text_[at_])))
      ++at_;
    if (at_ == start) fail("no word");
    return text_.substr(start, at_ - start);
  }
  std::string until(const std::string& mark) {
    const std::size_t start = at_, end = text_.find(mark, at_ + mark.size());
    if (end == std::string::npos) fail("no end of " + mark);
    at_ = end + mark.size();
    return text_.substr(start, at_ - start);
  }
  std::string string() {
    const std::size_t start = at_++;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    if (at_ >= text_.size()) fail("no end of a string");
    return text_.substr(start, ++at_ - start);
  }
  /// "(...)", "[...]" with whatever is inside.
  std::string balanced() {
    const std::size_t start = at_;
    int depth = 0;
    do {
      const char c = peek();
      if (c == '\0') fail("no closing bracket");
      if (c == '"') {
        string();
        continue;
      }
      depth += c == '(' || c == '[' || c == '{' ? 1 : c == ')' || c == ']' || c == '}' ? -1 : 0;
      ++at_;
    } while (depth > 0);
    return text_.substr(start, at_ - start);
  }
  std::string value() {
    switch (peek()) {
      case '(':
      case '[':
        return balanced();
      case '"':
        return string();
      case '@':
        return until(text_.compare(at_, 3, "@@@") == 0 ? "@@@" : "@");
      case '<':
        return until(">");
      default: {
        const std::size_t start = at_;
        while (at_ < text_.size() && !strchr(" \n,)", text_[at_])) ++at_;
        std::string number = text_.substr(start, at_ - start);
        std::size_t used = 0;
        std::stod(number, &used);
        if (used != number.size()) fail("no number: " + number);
        return number;
      }
    }
  }
  UsdPrim prim() {
    if (word() != "def") fail("no def");
    UsdPrim prim;
    prim.type = word();
    peek();
    const std::string quotedName = string();
    prim.name = quotedName.substr(1, quotedName.size() - 2);
    if (prim.name.empty() || std::isdigit(static_cast<unsigned char>(prim.name[0]))) fail("a bad name");
    for (const char c : prim.name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') fail("a bad name");
    if (peek() == '(') prim.metadata = balanced();
    expect('{');
    while (peek() != '}') {
      if (text_.compare(at_, 4, "def ") == 0)
        addChild(prim);
      else
        addProperty(prim);
    }
    expect('}');
    return prim;
  }
  void addChild(UsdPrim& parent) {
    UsdPrim child = prim();
    for (const UsdPrim& other : parent.children)
      if (other.name == child.name) fail("the name " + child.name + " twice");
    parent.children.push_back(std::move(child));
  }
  void addProperty(UsdPrim& prim) {
    std::string name = word();
    while (peek() != '=' && peek() != '}' && text_[at_ - 1] != '\n' && sameLine()) name += " " + word();
    if (peek() != '=') {
      prim.properties[name] = "";
      return;
    }
    expect('=');
    if (text_.find_first_not_of(' ', at_) == text_.find('\n', at_)) fail("a value on another line");
    if (name.ends_with(".timeSamples")) {
      readSamples(prim.timeSamples[name.substr(0, name.rfind('.'))]);
      return;
    }
    prim.properties[name] = value();
    if (peek() == '(') balanced();
  }
  /// The declaration of an output has no value: its line ends.
  bool sameLine() const {
    std::size_t back = at_;
    while (back > 0 && text_[back - 1] == ' ') --back;
    return back > 0 && text_[back - 1] != '\n';
  }
  void readSamples(std::map<int, std::string>& samples) {
    expect('{');
    while (peek() != '}') {
      std::size_t used = 0;
      const int code = std::stoi(text_.substr(at_, 12), &used);
      at_ += used;
      expect(':');
      samples[code] = value();
      if (peek() == ',') ++at_;
    }
    expect('}');
  }

  std::string text_;
  std::size_t at_ = 0;
};

/// The numbers in "(1, 2.5, -3)".
inline std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    if (!strchr("-0123456789", text[at])) {
      ++at;
      continue;
    }
    std::size_t used = 0;
    numbers.push_back(std::stod(text.substr(at, 32), &used));
    at += used;
  }
  return numbers;
}

}  // namespace brisance::test
