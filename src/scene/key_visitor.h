// One declaration per key of the scene file: readers, writers, the schema and the documents all visit the same ones.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Which values a number may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowIncluded = true;
  bool contains(double x) const { return (lowIncluded ? x >= low : x > low) && x <= high; }
};
constexpr Range anyValue{};
constexpr Range above(double low) { return {low, std::numeric_limits<double>::infinity(), false}; }
constexpr Range atLeast(double low) { return {low, std::numeric_limits<double>::infinity(), true}; }
constexpr Range between(double low, double high) { return {low, high, true}; }
/// "above 0", "from 0 to 1", or nothing for any value.
std::string rangeText(const Range& range);

/// A symbol of the thesis and the numbers of the tables that list it.
struct Symbol {
  const char* name = "";
  const char* tables = "";
};

/// What is declared of a key. A key whose unit is "m" is a length: the file gives it in scene units.
struct Key {
  const char* name;
  const char* unit;  ///< SI, or empty
  Range range;       ///< of each number in it
  const char* doc;   ///< one sentence
  Symbol symbol = {};
  const char* fallback = "";  ///< what holds where an optional key is not written
  bool required = false;
};
/// A length, as opposed to everything that only has metres in its unit.
inline bool isLength(const Key& key) { return std::string_view(key.unit) == "m"; }

using Names = std::span<const std::string_view>;
enum class Precision { single, full };

/// Something that is shown every key in turn, and may change its value.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  virtual void flag(const Key& key, bool& value) = 0;
  virtual void integers(const Key& key, std::span<std::int64_t> values) = 0;  ///< one: a number, several: an array
  virtual void numbers(const Key& key, std::span<double> values, Precision precision) = 0;
  virtual void places(const Key& key, std::vector<Vec2d>& values) = 0;  ///< [[x, y], ...], as many as there are
  virtual void text(const Key& key, std::string& value) = 0;
  virtual void file(const Key& key, std::filesystem::path& value) = 0;
  virtual void choice(const Key& key, Names names, std::size_t& index) = 0;
  /// Whether to visit an optional key that has, or has not, a value.
  virtual bool wants(const Key& key, bool hasValue) = 0;

  /// A table; `typeAlone`: it may be given as the text of its type.
  virtual void enter(const Key& key, bool typeAlone) = 0;
  virtual void leave() = 0;
  /// An array of tables; returns how many elements to visit.
  virtual std::size_t enterArray(const Key& key, std::size_t size) = 0;
  virtual void enterElement(std::size_t index) = 0;
  virtual void leaveElement() = 0;
  virtual void leaveArray() = 0;
  /// The table's key "type"; returns which alternatives to visit.
  virtual std::vector<std::size_t> alternatives(Names names, std::size_t current) = 0;
  virtual void enterAlternative(std::size_t) {}
  virtual void leaveAlternative() {}
};

// One function per type of field, so that a declaration reads: visit(v, {name, unit, range, doc}, settings.field).
void visit(KeyVisitor& v, const Key& key, bool& value);
void visit(KeyVisitor& v, const Key& key, int& value);
void visit(KeyVisitor& v, const Key& key, std::uint64_t& value);
void visit(KeyVisitor& v, const Key& key, Vec3i& value);
void visit(KeyVisitor& v, const Key& key, double& value);
void visit(KeyVisitor& v, const Key& key, Vec2d& value);
void visit(KeyVisitor& v, const Key& key, Vec3d& value);
void visit(KeyVisitor& v, const Key& key, Vec3f& value);
void visit(KeyVisitor& v, const Key& key, Quaternion& value);  ///< w, x, y, z
void visit(KeyVisitor& v, const Key& key, std::vector<Vec2d>& values);
void visit(KeyVisitor& v, const Key& key, std::string& value);
void visit(KeyVisitor& v, const Key& key, std::filesystem::path& value);

template <class T>
void visit(KeyVisitor& v, const Key& key, std::optional<T>& value) {
  if (!v.wants(key, value.has_value())) return;
  if (!value) value.emplace();
  visit(v, key, *value);
}

/// A choice between named values of an enum 0, 1, 2 ...
template <class Enum>
void visitChoice(KeyVisitor& v, const Key& key, Names names, Enum& value) {
  auto index = static_cast<std::size_t>(value);
  v.choice(key, names, index);
  value = static_cast<Enum>(index);
}

template <class Variant, std::size_t... I>
void emplaceAlternative(Variant& value, std::size_t index, std::index_sequence<I...>) {
  ((index == I ? void(value.template emplace<I>()) : void()), ...);
}
/// Makes `value` hold alternative `index`, keeping what it holds if it does already.
template <class... Ts>
void hold(std::variant<Ts...>& value, std::size_t index) {
  if (value.index() != index) emplaceAlternative(value, index, std::index_sequence_for<Ts...>{});
}

/// A choice between types without settings of their own.
template <class... Ts>
void visitType(KeyVisitor& v, const Key& key, Names names, std::variant<Ts...>& value) {
  std::size_t index = value.index();
  v.choice(key, names, index);
  hold(value, index);
}

/// The alternatives of the table that was entered last: its key "type", then the keys of that type. A visitor that
/// looks at several leaves the value as it was.
template <class Describe, class... Ts>
void visitAlternatives(KeyVisitor& v, Names names, std::variant<Ts...>& value, const Describe& describe) {
  const std::variant<Ts...> before = value;
  const std::vector<std::size_t> visited = v.alternatives(names, value.index());
  for (const std::size_t index : visited) {
    hold(value, index);
    v.enterAlternative(index);
    std::visit([&](auto& settings) { describe(v, settings); }, value);
    v.leaveAlternative();
  }
  if (visited.size() > 1) value = before;
}

template <class T, class Describe>
void visitArray(KeyVisitor& v, const Key& key, std::vector<T>& values, const T& fresh, const Describe& describe) {
  values.resize(v.enterArray(key, values.size()), fresh);
  for (std::size_t i = 0; i < values.size(); ++i) {
    v.enterElement(i);
    describe(v, values[i]);
    v.leaveElement();
  }
  v.leaveArray();
}

template <class T, class Describe>
void visitTable(KeyVisitor& v, const char* name, const char* doc, T& value, const Describe& describe) {
  v.enter({name, "", anyValue, doc}, false);
  describe(v, value);
  v.leave();
}

}  // namespace brisance
