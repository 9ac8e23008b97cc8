#include "mesh/ply_header.h"

#include <optional>

#include "mesh/mesh_text.h"

namespace brisance {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName typeNames[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file) : rest_(bytes), size_(bytes.size()), place_{file} {}

  PlyHeader read() {
    if (nextLine() != "ply") place_.fail("must begin with the line 'ply'");
    std::string_view line;
    while ((line = nextLine()) != "end_header") readLine(line);
    if (!hasFormat_) place_.fail("no line 'format', must come before end_header");
    header_.lines = place_.line;
    header_.bytes = size_ - rest_.size();
    return std::move(header_);
  }

 private:
  /// Lines end as on Unix, Windows or old Macs.
  std::string_view nextLine() {
    ++place_.line;
    const std::size_t end = rest_.find_first_of("\r\n");
    if (end == std::string_view::npos) place_.fail("the header ends early, must end with the line 'end_header'");
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1));
    return line;
  }

  void readLine(std::string_view line) {
    const std::string_view whole = line, keyword = nextWord(line);
    if (keyword == "format") return readFormat(trimmed(line));
    if (keyword == "element") return readElement(line);
    if (keyword == "property") return readProperty(line);
    if (keyword == "comment") return readComment(line);
    if (keyword != "obj_info" && !whole.empty())
      place_.fail(fmt::format("'{}': must be format, element, property, comment or end_header", shown(keyword)));
  }

  void readFormat(std::string_view format) {
    hasFormat_ = true;
    if (format == "ascii 1.0") return void(header_.encoding = PlyEncoding::ascii);
    if (format == "binary_little_endian 1.0") return void(header_.encoding = PlyEncoding::littleEndian);
    if (format == "binary_big_endian 1.0") return void(header_.encoding = PlyEncoding::bigEndian);
    place_.fail(
        fmt::format("format '{}': must be ascii, binary_little_endian or binary_big_endian 1.0", shown(format)));
  }

  void readElement(std::string_view line) {
    PlyElement element{std::string(nextWord(line)), 0, {}, place_.line};
    const std::string_view count = nextWord(line);
    if (!parseNumber(count, element.count))
      place_.fail(fmt::format("element {}: count '{}': must be a number from 0", shown(element.name), shown(count)));
    header_.elements.push_back(std::move(element));
  }

  void readProperty(std::string_view line) {
    if (header_.elements.empty()) place_.fail("a property before any element, must come after one");
    PlyProperty property;
    std::string_view word = nextWord(line);
    property.isList = word == "list";
    if (property.isList) {
      property.countType = typeNamed(nextWord(line));
      if (!isInteger(property.countType)) place_.fail("a list's count is of a broken type, must be of an integer one");
      word = nextWord(line);
    }
    property.type = typeNamed(word);
    property.name = nextWord(line);
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType typeNamed(std::string_view name) const {
    for (const TypeName& known : typeNames)
      if (known.name == name) return known.type;
    place_.fail(fmt::format("type '{}': must be char, uchar, short, ushort, int, uint, float or double", shown(name)));
  }

  void readComment(std::string_view line) {
    if (nextWord(line) != "material") return;
    const std::string name = printable(trimmed(line));
    header_.materialNames.push_back(name.empty() ? fmt::format("material {}", header_.materialNames.size()) : name);
  }

  std::string_view rest_;
  std::size_t size_;
  LinePlace place_;
  PlyHeader header_;
  bool hasFormat_ = false;
};

}  // namespace

std::size_t bytesOf(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

PlyHeader readPlyHeader(std::string_view bytes, const std::string& file) { return HeaderReader(bytes, file).read(); }

}  // namespace brisance
