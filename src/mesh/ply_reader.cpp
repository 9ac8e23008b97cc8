#include <algorithm>
#include <cstring>
#include <limits>

#include "mesh/corner_mesh.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_text.h"
#include "mesh/ply_header.h"

namespace brisance {
namespace {

/// Values as words; places in messages are lines.
class AsciiValues {
 public:
  AsciiValues(std::string_view rest, const std::string& file, std::size_t line) : rest_(rest), place_{file, line} {}

  double next(PlyType) {
    skipBlanks();
    std::size_t end = 0;
    while (end < rest_.size() && !isBlank(rest_[end]) && rest_[end] != '\n') ++end;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    double value = 0;
    if (word.empty()) fail("ends early, must hold all values that the header promises");
    if (!parseNumber(word, value)) fail(fmt::format("'{}': must be a number", shown(word)));
    return value;
  }
  void skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) next(type);
  }
  std::uint64_t room(PlyType) const { return (rest_.size() + 1) / 2; }  ///< values that may still come, at most
  /// Rows of `element` that may still come, at most: a value takes a digit and a blank.
  std::uint64_t roomFor(const PlyElement& element) const {
    return (rest_.size() + 1) / (2 * element.properties.size());
  }
  [[noreturn]] void fail(const std::string& trouble) const { place_.fail(trouble); }

 private:
  void skipBlanks() {
    std::size_t first = 0;
    for (; first < rest_.size() && (isBlank(rest_[first]) || rest_[first] == '\n'); ++first)
      place_.line += rest_[first] == '\n';
    rest_.remove_prefix(first);
  }

  std::string_view rest_;
  LinePlace place_;
};

/// Values as bytes; places in messages are bytes.
template <bool Swapped>
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, std::size_t first, const std::string& file)
      : bytes_(bytes), at_(first), file_(file) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }
  void skip(PlyType type, std::uint64_t count) {
    if (count > room(type)) failEarly();
    at_ += count * bytesOf(type);
  }
  std::uint64_t room(PlyType type) const { return (bytes_.size() - at_) / bytesOf(type); }
  std::uint64_t roomFor(const PlyElement& element) const {
    std::size_t row = 0;
    for (const PlyProperty& property : element.properties)
      row += bytesOf(property.isList ? property.countType : property.type);
    return (bytes_.size() - at_) / row;
  }
  [[noreturn]] void fail(const std::string& trouble) const {
    throw DamagedFile(fmt::format("{}:byte {}: {}", file_, at_, trouble));
  }

 private:
  [[noreturn]] void failEarly() const { fail("ends early, must hold all values that the header promises"); }

  template <class T>
  T take() {
    if (sizeof(T) > bytes_.size() - at_) failEarly();
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if constexpr (Swapped) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  std::size_t at_;
  const std::string& file_;
};

/// Where a property's values go: a number of VertexRow or FaceRow, or nowhere.
enum class Target { none, x, y, z, nx, ny, nz, u, v, corners, material };

struct NamedTarget {
  std::string_view name;
  Target target;
};
constexpr NamedTarget vertexTargets[] = {{"x", Target::x},   {"y", Target::y},         {"z", Target::z},
                                         {"nx", Target::nx}, {"ny", Target::ny},       {"nz", Target::nz},
                                         {"s", Target::u},   {"t", Target::v},         {"u", Target::u},
                                         {"v", Target::v},   {"texture_u", Target::u}, {"texture_v", Target::v}};
constexpr NamedTarget faceTargets[] = {
    {"vertex_indices", Target::corners}, {"vertex_index", Target::corners}, {"material_index", Target::material}};

template <std::size_t N>
std::vector<Target> targetsOf(const PlyElement& element, const NamedTarget (&names)[N]) {
  std::vector<Target> targets;
  for (const PlyProperty& property : element.properties) {
    const auto* known = std::find_if(names, names + N, [&](const NamedTarget& n) { return n.name == property.name; });
    const bool fits = known != names + N && property.isList == (known->target == Target::corners);
    targets.push_back(fits ? known->target : Target::none);
  }
  return targets;
}

bool has(const std::vector<Target>& targets, std::initializer_list<Target> all) {
  return std::all_of(all.begin(), all.end(),
                     [&](Target t) { return std::find(targets.begin(), targets.end(), t) != targets.end(); });
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Values values, const std::string& file)
      : header_(header), values_(std::move(values)), file_(file) {}

  TriangleMesh read() {
    for (const PlyElement& element : header_.elements) readElement(element);
    if (mesh_.triangles.empty()) throw DamagedFile(file_ + ": no face, must hold an element 'face' of at least one");
    if (!mesh_.normals.empty()) finishNormals();
    if (!mesh_.materials.empty()) finishMaterials();
    return std::move(mesh_);
  }

 private:
  void readElement(const PlyElement& element) {
    if (element.properties.empty()) return;  // holds no value however often
    demandRoom(element);
    if (element.name == "vertex" && mesh_.vertices.empty()) return readVertices(element);
    if (element.name == "face") return readFaces(element);
    for (std::uint64_t n = 0; n < element.count; ++n)
      for (const PlyProperty& property : element.properties) skip(property);
  }

  /// A count that the bytes cannot hold is refused before anything is made for it.
  void demandRoom(const PlyElement& element) const {
    const std::uint64_t room = values_.roomFor(element);
    if (element.count > room)
      throw DamagedFile(fmt::format("{}:{}: element {}: promises {}, must be at most {} in a file of this size", file_,
                                    element.line, shown(element.name), element.count, room));
  }

  std::uint64_t listLength(const PlyProperty& property) {
    const double count = values_.next(property.countType);
    const std::uint64_t room = values_.room(property.type);
    if (!(count >= 0 && count <= static_cast<double>(room)) || count != std::floor(count))
      values_.fail(
          fmt::format("{}: a list of {}, must be 0 to {} in a file of this size", shown(property.name), count, room));
    return static_cast<std::uint64_t>(count);
  }

  void skip(const PlyProperty& property) { values_.skip(property.type, property.isList ? listLength(property) : 1); }

  double finite(const PlyProperty& property) {
    const double value = values_.next(property.type);
    if (!std::isfinite(value))
      values_.fail(fmt::format("{}: {}, must be a finite number", shown(property.name), value));
    return value;
  }

  void readVertices(const PlyElement& element) {
    const std::vector<Target> targets = targetsOf(element, vertexTargets);
    if (!has(targets, {Target::x, Target::y, Target::z}))
      throw DamagedFile(fmt::format("{}:{}: a vertex without place, must have x, y and z", file_, element.line));
    const bool hasNormals = has(targets, {Target::nx, Target::ny, Target::nz});
    const bool hasUvs = has(targets, {Target::u, Target::v});
    mesh_.vertices.reserve(element.count);
    for (std::uint64_t n = 0; n < element.count; ++n) {
      double row[static_cast<int>(Target::v) + 1] = {};
      for (std::size_t p = 0; p < targets.size(); ++p) {
        if (targets[p] == Target::none)
          skip(element.properties[p]);
        else
          row[static_cast<int>(targets[p])] = finite(element.properties[p]);
      }
      mesh_.vertices.push_back({row[1], row[2], row[3]});
      if (hasNormals) mesh_.normals.push_back({row[4], row[5], row[6]});
      if (hasUvs) mesh_.uvs.push_back({row[7], row[8]});
    }
    if (mesh_.vertices.size() > notGiven) values_.fail("more vertices than 4294967295");
  }

  void readFaces(const PlyElement& element) {
    const std::vector<Target> targets = targetsOf(element, faceTargets);
    if (!has(targets, {Target::corners}))
      throw DamagedFile(
          fmt::format("{}:{}: a face without corners, must have a list vertex_indices", file_, element.line));
    const bool hasMaterials = has(targets, {Target::material}) && !header_.materialNames.empty();
    for (std::uint64_t n = 0; n < element.count; ++n) {
      const std::size_t before = mesh_.triangles.size();
      std::uint16_t material = 0;
      for (std::size_t p = 0; p < targets.size(); ++p) {
        if (targets[p] == Target::corners)
          readFace(element.properties[p]);
        else if (targets[p] == Target::material && hasMaterials)
          material = readMaterial(element.properties[p]);
        else
          skip(element.properties[p]);
      }
      if (hasMaterials) mesh_.materials.insert(mesh_.materials.end(), mesh_.triangles.size() - before, material);
    }
  }

  void readFace(const PlyProperty& property) {
    const std::uint64_t count = listLength(property);
    if (count < 3) values_.fail(fmt::format("a face of {} corners, must be at least 3", count));
    const std::uint32_t first = readCorner(property);
    std::uint32_t last = readCorner(property);
    for (std::uint64_t i = 2; i < count; ++i) {
      const std::uint32_t next = readCorner(property);
      mesh_.triangles.push_back({first, last, next});
      last = next;
    }
  }

  std::uint32_t readCorner(const PlyProperty& property) {
    const double index = values_.next(property.type);
    const std::size_t count = mesh_.vertices.size();
    if (!(index >= 0 && index < static_cast<double>(count)) || index != std::floor(index))
      values_.fail(count == 0 ? fmt::format("vertex {}: no vertex comes before it", index)
                              : fmt::format("vertex {}: must be 0 to {}", index, count - 1));
    return static_cast<std::uint32_t>(index);
  }

  std::uint16_t readMaterial(const PlyProperty& property) {
    const double index = values_.next(property.type);
    const std::size_t count = std::min<std::size_t>(header_.materialNames.size(), 0x10000);
    if (!(index >= 0 && index < static_cast<double>(count)) || index != std::floor(index))
      values_.fail(fmt::format("material {}: must be 0 to {}", index, count - 1));
    return static_cast<std::uint16_t>(index);
  }

  void finishNormals() {
    std::vector<bool> given(mesh_.normals.size());
    for (std::size_t v = 0; v < given.size(); ++v) given[v] = mesh_.normals[v] != Vec3d{};
    makeUpNormals(mesh_, given);
  }

  void finishMaterials() {
    mesh_.materialNames = header_.materialNames;
    mesh_.materials.resize(mesh_.triangles.size());
  }

  const PlyHeader& header_;
  Values values_;
  const std::string& file_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh plyFromBytes(std::string_view bytes, const std::string& file) {
  const PlyHeader header = readPlyHeader(bytes, file);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      return PlyReader(header, AsciiValues(bytes.substr(header.bytes), file, header.lines + 1), file).read();
    case PlyEncoding::littleEndian:
      return PlyReader(header, BinaryValues<false>(bytes, header.bytes, file), file).read();
    case PlyEncoding::bigEndian:
      return PlyReader(header, BinaryValues<true>(bytes, header.bytes, file), file).read();
  }
  return {};
}

}  // namespace brisance
