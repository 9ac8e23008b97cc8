#include "scene/key_visitor.h"

#include <fmt/format.h>

namespace brisance {
namespace {

template <class T>
void visitInteger(KeyVisitor& v, const Key& key, T& value) {
  std::int64_t wide[] = {static_cast<std::int64_t>(value)};
  v.integers(key, wide);
  value = static_cast<T>(wide[0]);
}

/// Visits components as an array of doubles and puts them back.
template <class... Ts>
void visitNumbers(KeyVisitor& v, const Key& key, Precision precision, Ts&... components) {
  double wide[] = {static_cast<double>(components)...};
  v.numbers(key, wide, precision);
  const double* next = wide;
  ((components = static_cast<Ts>(*next++)), ...);
}

}  // namespace

std::string rangeText(const Range& range) {
  const bool bounded = range.high < std::numeric_limits<double>::infinity();
  if (range.low == -std::numeric_limits<double>::infinity())
    return bounded ? fmt::format("at most {}", range.high) : "";
  const std::string low =
      fmt::format("{} {}", range.lowIncluded ? (bounded ? "from" : "at least") : "above", range.low);
  return bounded ? fmt::format("{} {} {}", low, range.lowIncluded ? "to" : "and at most", range.high) : low;
}

void visit(KeyVisitor& v, const Key& key, bool& value) { v.flag(key, value); }
void visit(KeyVisitor& v, const Key& key, int& value) { visitInteger(v, key, value); }
void visit(KeyVisitor& v, const Key& key, std::uint64_t& value) { visitInteger(v, key, value); }
void visit(KeyVisitor& v, const Key& key, Vec3i& value) {
  std::int64_t wide[] = {value.x, value.y, value.z};
  v.integers(key, wide);
  value = {static_cast<int>(wide[0]), static_cast<int>(wide[1]), static_cast<int>(wide[2])};
}
void visit(KeyVisitor& v, const Key& key, double& value) { visitNumbers(v, key, Precision::full, value); }
void visit(KeyVisitor& v, const Key& key, Vec2d& value) { visitNumbers(v, key, Precision::full, value.x, value.y); }
void visit(KeyVisitor& v, const Key& key, Vec3d& value) {
  visitNumbers(v, key, Precision::full, value.x, value.y, value.z);
}
void visit(KeyVisitor& v, const Key& key, Vec3f& value) {
  visitNumbers(v, key, Precision::single, value.x, value.y, value.z);
}
void visit(KeyVisitor& v, const Key& key, Quaternion& value) {
  visitNumbers(v, key, Precision::full, value.w, value.x, value.y, value.z);
}
void visit(KeyVisitor& v, const Key& key, std::vector<Vec2d>& values) { v.places(key, values); }
void visit(KeyVisitor& v, const Key& key, std::string& value) { v.text(key, value); }
void visit(KeyVisitor& v, const Key& key, std::filesystem::path& value) { v.file(key, value); }

}  // namespace brisance
