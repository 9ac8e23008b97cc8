#include <cstring>
#include <limits>
#include <map>

#include "mesh/corner_mesh.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_text.h"

namespace brisance {
namespace {

constexpr std::size_t mostMaterials = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

/// Up to three numbers; `needed` of them must be there, the others are 0.
Vec3d parseReals(std::string_view text, int needed, const LinePlace& place) {
  Vec3d values;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = nextWord(text);
    if (word.empty() && i < needed) place.fail(fmt::format("{} numbers, must be at least {}", i, needed));
    if (!word.empty()) values[i] = parseReal(word, place);
  }
  return values;
}

class ObjReader {
 public:
  explicit ObjReader(const std::string& file) : place_{file} {}

  CornerMesh read(std::string_view text) {
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    while (!text.empty()) {
      ++place_.line;
      const std::size_t end = std::min(text.find('\n'), text.size());
      readPart(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    readLine(continued_);
    if (content_.triangles.empty()) throw DamagedFile(place_.file + ": no face, must hold at least one line 'f'");
    if (!namesMaterials_) {
      content_.materials.clear();
      content_.materialNames.clear();
    }
    return std::move(content_);
  }

 private:
  /// A line that ends with a backslash goes on in the next one.
  void readPart(std::string_view part) {
    while (!part.empty() && isBlank(part.back())) part.remove_suffix(1);
    const bool goesOn = part.ends_with('\\');
    if (goesOn) part.remove_suffix(1);
    if (!goesOn && continued_.empty()) return readLine(part);
    continued_.append(part).push_back(' ');
    if (goesOn) return;
    readLine(continued_);
    continued_.clear();
  }

  void readLine(std::string_view line) {
    if (const void* comment = line.empty() ? nullptr : std::memchr(line.data(), '#', line.size()))
      line = line.substr(0, static_cast<std::size_t>(static_cast<const char*>(comment) - line.data()));
    const std::string_view keyword = nextWord(line);
    if (keyword == "v") return content_.positions.push_back(parseReals(line, 3, place_));
    if (keyword == "f") return readFace(line);
    if (keyword == "vn") return content_.normals.push_back(parseReals(line, 3, place_));
    if (keyword == "vt") {
      const Vec3d uv = parseReals(line, 1, place_);
      content_.uvs.push_back({uv.x, uv.y});
    }
    if (keyword == "usemtl") useMaterial(printable(trimmed(line)));
  }

  void readFace(std::string_view line) {
    corners_.clear();
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line))
      corners_.push_back(readCorner(word));
    if (corners_.size() < 3) place_.fail(fmt::format("a face of {} corners, must be at least 3", corners_.size()));
    if (content_.materialNames.empty()) material_ = materialNumber("default");
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
      content_.triangles.push_back({corners_[0], corners_[i], corners_[i + 1]});
      content_.materials.push_back(material_);
    }
  }

  Corner readCorner(std::string_view word) const {
    const std::string_view whole = word;
    std::string_view parts[3];
    for (std::string_view& part : parts) {
      const std::size_t end = std::min(word.find('/'), word.size());
      part = word.substr(0, end);
      word.remove_prefix(std::min(end + 1, word.size()));
    }
    if (!word.empty()) place_.fail(fmt::format("'{}': must be like 1, 1/2, 1//3 or 1/2/3", shown(whole)));
    if (parts[0].empty()) place_.fail(fmt::format("'{}': must begin with a vertex number", shown(whole)));
    return {readIndex(parts[0], content_.positions.size(), "vertex"),
            readIndex(parts[1], content_.uvs.size(), "texture coordinate"),
            readIndex(parts[2], content_.normals.size(), "normal")};
  }

  /// From 1 up, or from -1 back; of what the file has named so far.
  std::uint32_t readIndex(std::string_view word, std::size_t size, const char* what) const {
    if (word.empty()) return notGiven;
    const auto count = static_cast<std::int64_t>(std::min<std::size_t>(size, notGiven));
    std::int64_t index = 0;
    if (!parseNumber(word, index) || index == 0 || index > count || index < -count)
      place_.fail(count == 0 ? fmt::format("{} {}: no {} comes before it", what, shown(word), what)
                             : fmt::format("{} {}: must be 1 to {}, or -{} to -1", what, shown(word), count, count));
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
  }

  void useMaterial(const std::string& name) {
    if (name.empty()) place_.fail("usemtl: must be followed by a material's name");
    material_ = materialNumber(name);
    namesMaterials_ = true;
  }

  std::uint16_t materialNumber(const std::string& name) {
    const auto [entry, isNew] = numberOf_.try_emplace(name, content_.materialNames.size());
    if (isNew) content_.materialNames.push_back(name);
    if (content_.materialNames.size() > mostMaterials)
      place_.fail(fmt::format("more materials than {}", mostMaterials));
    return static_cast<std::uint16_t>(entry->second);
  }

  LinePlace place_;
  CornerMesh content_;
  std::vector<Corner> corners_;  ///< of the face being read
  std::string continued_;
  std::map<std::string, std::size_t> numberOf_;
  std::uint16_t material_ = 0;
  bool namesMaterials_ = false;
};

}  // namespace

TriangleMesh objFromBytes(std::string_view bytes, const std::string& file) {
  return withSharedVertices(ObjReader(file).read(bytes));
}

}  // namespace brisance
