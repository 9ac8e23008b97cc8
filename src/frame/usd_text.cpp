#include "frame/usd_text.h"

namespace brisance::usd {

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string inQuotes(std::string_view text) {
  constexpr unsigned char firstPrintable = 0x20;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < firstPrintable)
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + "\"";
}

std::string asset(std::string_view path) {
  const char* mark = path.find('@') == path.npos ? "@" : "@@@";
  return fmt::format("{}{}{}", mark, path, mark);
}

std::string value(const Vec3f& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string value(const Vec3d& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string value(const Vec2<float>& v) { return fmt::format("({}, {})", v.x, v.y); }
std::string value(std::uint32_t number) { return std::to_string(number); }
std::string value(const Quaternion& q) {
  return fmt::format("({}, {}, {}, {})", static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                     static_cast<float>(q.z));
}

std::string Names::unique(std::string_view name) {
  std::string legal;
  if (name.empty() || isDigit(name.front())) legal = "_";
  for (const char c : name) legal += isLetter(c) || isDigit(c) ? c : '_';
  std::string candidate = legal;
  for (int n = 2; !taken_.insert(candidate).second; ++n) candidate = fmt::format("{}_{}", legal, n);
  return candidate;
}

}  // namespace brisance::usd
