// Words and numbers of mesh files that people, programs or attackers wrote.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "base/check.h"

namespace brisance {

/// A line of a file, for messages.
struct LinePlace {
  const std::string& file;
  std::size_t line = 0;
  [[noreturn]] void fail(const std::string& trouble) const {
    throw DamagedFile(fmt::format("{}:{}: {}", file, line, trouble));
  }
};

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Cuts the next word off the front of a line; empty at its end.
inline std::string_view nextWord(std::string_view& line) {
  std::size_t first = 0;
  while (first < line.size() && isBlank(line[first])) ++first;
  std::size_t end = first;
  while (end < line.size() && !isBlank(line[end])) ++end;
  const std::string_view word = line.substr(first, end - first);
  line.remove_prefix(end);
  return word;
}

/// What a message may show of a word from a file that may hold anything.
inline std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

/// A name without control characters, which could end a line that it is written in.
inline std::string printable(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
  return text;
}

/// The whole word as a number; a leading plus sign is allowed.
template <class Number>
bool parseNumber(std::string_view word, Number& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, trouble] = std::from_chars(word.data(), word.data() + word.size(), value);
  return trouble == std::errc{} && end == word.data() + word.size() && !word.empty();
}

inline double parseReal(std::string_view word, const LinePlace& place) {
  double value = 0;
  if (!parseNumber(word, value) || !std::isfinite(value))
    place.fail(fmt::format("'{}': must be a finite number", shown(word)));
  return value;
}

}  // namespace brisance
