#include "mesh/gltf_uri.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace brisance {

namespace fs = std::filesystem;

namespace {

int valueOf64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::string> decoded64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = valueOf64(c);
    if (value < 0) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 0xFF));
  }
  return bytes;
}

std::optional<std::string> withoutPercents(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text.push_back(uri[i]);
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = uri.substr(i + 1, 2);
    const auto [end, trouble] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (trouble != std::errc{} || digits.size() != 2 || end != digits.data() + 2) return {};
    text.push_back(static_cast<char>(value));
    i += 2;
  }
  return text;
}

bool staysBelow(const std::string& path) {
  if (path.empty() || path.find('\0') != std::string::npos || path.find(':') != std::string::npos ||
      path.find('\\') != std::string::npos)
    return false;
  const fs::path relative(path);
  return relative.is_relative() && std::find(relative.begin(), relative.end(), "..") == relative.end();
}

bool liesIn(const fs::path& folder, const fs::path& file) {
  std::error_code trouble;
  const fs::path whole = fs::canonical(file, trouble), base = fs::canonical(folder, trouble);
  if (trouble) return false;
  const fs::path relative = whole.lexically_relative(base);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace brisance
