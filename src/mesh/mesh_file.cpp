#include "mesh/mesh_file.h"

#include <charconv>
#include <limits>
#include <map>
#include <string_view>

#include "base/check.h"
#include "base/durable_file.h"

namespace brisance {
namespace {

constexpr std::int64_t absent = -1;
constexpr std::size_t mostMaterials = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};

/// A place in the file, for messages.
struct Place {
  const std::string& file;
  std::size_t line = 0;
  [[noreturn]] void fail(const std::string& trouble) const {
    throw DamagedFile(fmt::format("{}:{}: {}", file, line, trouble));
  }
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Cuts the next word off the front of `text`; empty at the end.
std::string_view nextWord(std::string_view& text) {
  text = trimmed(text);
  const std::size_t end = std::min(text.find_first_of(" \t\r"), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

/// What a message may show of a word from a file that may hold anything.
std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

template <class Number>
bool parseNumber(std::string_view word, Number& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, trouble] = std::from_chars(word.data(), word.data() + word.size(), value);
  return trouble == std::errc{} && end == word.data() + word.size() && !word.empty();
}

double parseReal(std::string_view word, const Place& place) {
  double value = 0;
  if (!parseNumber(word, value) || !std::isfinite(value))
    place.fail(fmt::format("'{}': must be a finite number", shown(word)));
  return value;
}

/// Up to three numbers; `needed` of them must be there, the others are 0.
Vec3d parseReals(std::string_view text, int needed, const Place& place) {
  Vec3d values;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = nextWord(text);
    if (word.empty() && i < needed) place.fail(fmt::format("{} numbers, must be at least {}", i, needed));
    if (!word.empty()) values[i] = parseReal(word, place);
  }
  return values;
}

/// Numbers of a corner's position, texture coordinate and normal, from 0; `absent` where not given.
struct Corner {
  std::int64_t position = absent, uv = absent, normal = absent;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

/// What the file's lines say, before vertices are made of it.
struct ObjContent {
  std::vector<Vec3d> positions, normals;
  std::vector<Vec2d> uvs;
  std::vector<std::array<Corner, 3>> triangles;
  std::vector<std::uint16_t> materials;
  std::vector<std::string> materialNames;
};

class ObjReader {
 public:
  explicit ObjReader(const std::string& file) : place_{file} {}

  ObjContent read(std::string_view text) {
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
    part = trimmed(part);
    const bool goesOn = part.ends_with('\\');
    if (goesOn) part.remove_suffix(1);
    if (!goesOn && continued_.empty()) return readLine(part);
    continued_.append(part).push_back(' ');
    if (goesOn) return;
    readLine(continued_);
    continued_.clear();
  }

  void readLine(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = nextWord(line);
    if (keyword == "v") content_.positions.push_back(parseReals(line, 3, place_));
    if (keyword == "vn") content_.normals.push_back(parseReals(line, 3, place_));
    if (keyword == "vt") {
      const Vec3d uv = parseReals(line, 1, place_);
      content_.uvs.push_back({uv.x, uv.y});
    }
    if (keyword == "f") readFace(line);
    if (keyword == "usemtl") useMaterial(std::string(trimmed(line)));
  }

  void readFace(std::string_view line) {
    std::vector<Corner> corners;
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line))
      corners.push_back(readCorner(word));
    if (corners.size() < 3) place_.fail(fmt::format("a face of {} corners, must be at least 3", corners.size()));
    if (content_.materialNames.empty()) material_ = materialNumber("default");
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) addTriangle(corners[0], corners[i], corners[i + 1]);
  }

  /// A triangle that comes back to one of its corners bounds nothing, and is left out.
  void addTriangle(const Corner& a, const Corner& b, const Corner& c) {
    if (a.position == b.position || b.position == c.position || c.position == a.position) return;
    content_.triangles.push_back({a, b, c});
    content_.materials.push_back(material_);
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
  std::int64_t readIndex(std::string_view word, std::size_t size, const char* what) const {
    if (word.empty()) return absent;
    const auto count = static_cast<std::int64_t>(size);
    std::int64_t index = 0;
    if (!parseNumber(word, index) || index == 0 || index > count || index < -count)
      place_.fail(count == 0 ? fmt::format("{} {}: no {} comes before it", what, shown(word), what)
                             : fmt::format("{} {}: must be 1 to {}, or -{} to -1", what, shown(word), count, count));
    return index > 0 ? index - 1 : count + index;
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

  Place place_;
  ObjContent content_;
  std::string continued_;
  std::map<std::string, std::size_t> numberOf_;
  std::uint16_t material_ = 0;
  bool namesMaterials_ = false;
};

/// Makes vertices: a position keeps its number for the first corner that uses it, further ones follow all positions.
class VertexSplitter {
 public:
  explicit VertexSplitter(const ObjContent& content) : content_(content), cornerOf_(content.positions.size()) {
    mesh_.vertices = content.positions;
  }

  TriangleMesh build() {
    for (const auto& corners : content_.triangles)
      mesh_.triangles.push_back({vertexOf(corners[0]), vertexOf(corners[1]), vertexOf(corners[2])});
    mesh_.materials = content_.materials;
    mesh_.materialNames = content_.materialNames;
    if (!content_.uvs.empty()) gatherUvs();
    if (!content_.normals.empty()) gatherNormals();
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertexOf(const Corner& corner) {
    Corner& first = cornerOf_[corner.position];
    if (first.position == absent) first = corner;
    if (first == corner) return static_cast<std::uint32_t>(corner.position);
    const auto [copy, isNew] = copies_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (isNew) {
      mesh_.vertices.push_back(content_.positions[corner.position]);
      cornerOf_.push_back(corner);
    }
    return copy->second;
  }

  void gatherUvs() {
    for (const Corner& corner : cornerOf_) mesh_.uvs.push_back(corner.uv == absent ? Vec2d{} : content_.uvs[corner.uv]);
  }

  /// A vertex without a normal in a file with some gets the mean over its triangles, by area.
  void gatherNormals() {
    for (const Corner& corner : cornerOf_)
      mesh_.normals.push_back(corner.normal == absent ? Vec3d{} : content_.normals[corner.normal]);
    std::vector<bool> given;
    for (const Vec3d& normal : mesh_.normals) given.push_back(normal != Vec3d{});
    for (const auto& [a, b, c] : mesh_.triangles) {
      const Vec3d& origin = mesh_.vertices[a];
      const Vec3d doubleArea = cross(mesh_.vertices[b] - origin, mesh_.vertices[c] - origin);
      for (const std::uint32_t v : {a, b, c})
        if (!given[v]) mesh_.normals[v] += doubleArea;
    }
    for (std::size_t v = 0; v < given.size(); ++v)
      if (!given[v]) mesh_.normals[v] = normalized(mesh_.normals[v]);
  }

  const ObjContent& content_;
  TriangleMesh mesh_;
  std::vector<Corner> cornerOf_;  ///< per vertex
  std::map<Corner, std::uint32_t> copies_;
};

void appendVertices(fmt::memory_buffer& text, const TriangleMesh& mesh) {
  const auto out = fmt::appender(text);
  for (const Vec3d& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x, v.y, v.z);
  for (const Vec2d& uv : mesh.uvs) fmt::format_to(out, "vt {} {}\n", uv.x, uv.y);
  for (const Vec3d& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n.x, n.y, n.z);
}

std::string cornerText(const TriangleMesh& mesh, std::uint32_t vertex) {
  const std::uint32_t n = vertex + 1;
  if (mesh.uvs.empty()) return mesh.normals.empty() ? fmt::format(" {}", n) : fmt::format(" {}//{}", n, n);
  return mesh.normals.empty() ? fmt::format(" {}/{}", n, n) : fmt::format(" {}/{}/{}", n, n, n);
}

void appendFaces(fmt::memory_buffer& text, const TriangleMesh& mesh) {
  const auto out = fmt::appender(text);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.materials.empty() && (t == 0 || mesh.materials[t] != mesh.materials[t - 1]))
      fmt::format_to(out, "usemtl {}\n", mesh.materialNames.at(mesh.materials[t]));
    const auto& [a, b, c] = mesh.triangles[t];
    fmt::format_to(out, "f{}{}{}\n", cornerText(mesh, a), cornerText(mesh, b), cornerText(mesh, c));
  }
}

}  // namespace

TriangleMesh readObj(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) throw InputError(file + ": does not exist, must be an OBJ file");
  if (!std::filesystem::is_regular_file(path, trouble)) throw InputError(file + ": is no file, must be an OBJ file");
  const ObjContent content = ObjReader(file).read(readFile(path));
  return VertexSplitter(content).build();
}

void writeObj(const std::filesystem::path& path, const TriangleMesh& mesh) {
  fmt::memory_buffer text;
  appendVertices(text, mesh);
  appendFaces(text, mesh);
  writeDurably(path, std::string_view(text.data(), text.size()));
}

}  // namespace brisance
