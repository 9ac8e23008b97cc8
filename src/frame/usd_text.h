// The words of a USD text layer (usda): values, strings, names, nested prims.
#pragma once

#include <fmt/format.h>

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/math.h"

namespace brisance::usd {

/// "like this", with what would end it escaped.
std::string inQuotes(std::string_view text);
/// @like/this@
std::string asset(std::string_view path);

std::string value(const Vec3f& v);
std::string value(const Vec3d& v);
std::string value(const Vec2<float>& v);
std::string value(std::uint32_t number);
/// Real part first, as USD writes them.
std::string value(const Quaternion& q);

template <class T>
std::string list(const std::vector<T>& values) {
  std::string text = "[";
  for (const T& v : values) text += (text.size() > 1 ? ", " : "") + value(v);
  return text + "]";
}

/// Names that USD takes (a letter or _, then letters, digits and _), each given out once: "pane.007" is pane_007.
class Names {
 public:
  std::string unique(std::string_view name);

 private:
  std::set<std::string> taken_;
};

/// Lines with their indentation.
class Writer {
 public:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    text_.append(depth_ * indentation, ' ');
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_.push_back('\n');
  }
  /// A line that begins something in braces: all that follows lies one step further in, up to close().
  template <class... Args>
  void begin(fmt::format_string<Args...> format, Args&&... args) {
    line(format, std::forward<Args>(args)...);
    ++depth_;
  }
  /// A line, "{" on the next one (as prims have it), and all that follows one step further in, up to close().
  template <class... Args>
  void open(fmt::format_string<Args...> format, Args&&... args) {
    line(format, std::forward<Args>(args)...);
    line("{{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}}");
  }
  std::string take() { return std::move(text_); }

 private:
  static constexpr std::size_t indentation = 4;
  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace brisance::usd
