#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "base/check.h"
#include "frame/gltf_export.h"
#include "frame/gltf_format.h"

namespace brisance {

namespace {

using Json = nlohmann::json;

/// What is wrong, without the file's name.
struct BadGlb {
  std::string what;
};

void require(bool condition, const char* what) {
  if (!condition) throw BadGlb{what};
}

std::uint32_t wordAt(const std::string& bytes, std::size_t offset) {
  require(offset + sizeof(std::uint32_t) <= bytes.size(), "ends early");
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

struct Chunks {
  std::string_view json, binary;
};

std::string_view chunkAt(const std::string& bytes, std::size_t offset, std::uint32_t type) {
  const std::size_t length = wordAt(bytes, offset), start = offset + gltf::chunkHeaderBytes;
  require(wordAt(bytes, offset + sizeof(std::uint32_t)) == type, "has an unknown chunk");
  require(length <= bytes.size() - start, "ends early");
  return std::string_view(bytes).substr(start, length);
}

Chunks splitChunks(const std::string& bytes) {
  require(wordAt(bytes, 0) == gltf::magic && wordAt(bytes, 4) == gltf::version, "is no binary glTF 2.0");
  require(wordAt(bytes, 8) == bytes.size(), "has another length than it says");
  Chunks chunks{chunkAt(bytes, gltf::headerBytes, gltf::jsonChunk), {}};
  const std::size_t next = gltf::headerBytes + gltf::chunkHeaderBytes + chunks.json.size();
  if (next < bytes.size()) chunks.binary = chunkAt(bytes, next, gltf::binaryChunk);
  return chunks;
}

/// An integer from 0 to `limit` - 1.
std::size_t numberBelow(const Json& value, std::size_t limit, const char* what) {
  require(value.is_number_unsigned() && value.get<std::uint64_t>() < limit, what);
  return value.get<std::size_t>();
}

double finiteNumber(const Json& value) {
  require(value.is_number() && std::isfinite(value.get<double>()), "holds something else where a number belongs");
  return value.get<double>();
}

/// Reads the parts of one glTF that piecesToGlb wrote.
class GlbReader {
 public:
  explicit GlbReader(const Chunks& chunks) : root_(Json::parse(chunks.json)), binary_(chunks.binary) {}

  std::vector<FrameBody> bodies() {
    std::vector<FrameBody> bodies;
    if (root_.contains("nodes"))
      for (const Json& node : root_.at("nodes")) bodies.push_back(body(node));
    return bodies;
  }

 private:
  FrameBody body(const Json& node) {
    const Json& p = node.at("translation");
    const Json& q = node.at("rotation");
    FrameBody body;
    body.name = node.at("name").get<std::string>();
    body.material = node.at("extras").at("material").get<std::string>();
    body.moves = node.at("extras").at("moves").get<bool>();
    body.pose.position = {finiteNumber(p.at(0)), finiteNumber(p.at(1)), finiteNumber(p.at(2))};
    body.pose.orientation = {finiteNumber(q.at(3)), finiteNumber(q.at(0)), finiteNumber(q.at(1)),
                             finiteNumber(q.at(2))};
    body.mesh = node.contains("mesh") ? mesh(node.at("mesh")) : std::make_shared<const TriangleMesh>();
    return body;
  }

  std::shared_ptr<const TriangleMesh> mesh(const Json& numberInFile) {
    const Json& all = root_.at("meshes");
    const std::size_t number = numberBelow(numberInFile, all.size(), "names a mesh that is not there");
    auto& known = meshes_[number];
    if (!known) known = std::make_shared<const TriangleMesh>(readMesh(all.at(number)));
    return known;
  }

  TriangleMesh readMesh(const Json& entry) {
    TriangleMesh mesh;
    const Json& primitives = entry.at("primitives");
    readAttributes(primitives.at(0).at("attributes"), mesh);
    if (entry.contains("extras"))
      mesh.materialNames = entry.at("extras").at("materialNames").get<std::vector<std::string>>();
    for (const Json& primitive : primitives) readPrimitive(primitive, mesh);
    return mesh;
  }

  void readAttributes(const Json& attributes, TriangleMesh& mesh) {
    for (const Vec3f& p : accessor<Vec3f>(attributes.at("POSITION"), gltf::vec3, gltf::float32)) {
      require(isFinite(p), "has a vertex that is not finite");
      mesh.vertices.emplace_back(p);
    }
    if (attributes.contains("NORMAL"))
      for (const Vec3f& n : accessor<Vec3f>(attributes.at("NORMAL"), gltf::vec3, gltf::float32))
        mesh.normals.emplace_back(n);
    if (attributes.contains("TEXCOORD_0"))
      for (const auto& uv : accessor<Vec2<float>>(attributes.at("TEXCOORD_0"), gltf::vec2, gltf::float32))
        mesh.uvs.push_back({uv.x, 1.0 - uv.y});
    require(mesh.normals.empty() || mesh.normals.size() == mesh.vertices.size(), "has another number of normals");
    require(mesh.uvs.empty() || mesh.uvs.size() == mesh.vertices.size(), "has another number of texture coordinates");
  }

  void readPrimitive(const Json& primitive, TriangleMesh& mesh) {
    const auto indices = accessor<std::uint32_t>(primitive.at("indices"), gltf::scalar, gltf::uint32);
    require(indices.size() % 3 == 0, "has a triangle of fewer than three corners");
    for (std::size_t n = 0; n < indices.size(); n += 3)
      mesh.triangles.push_back({indices[n], indices[n + 1], indices[n + 2]});
    for (const std::uint32_t index : indices) require(index < mesh.vertices.size(), "names a vertex that is not there");
    if (mesh.materialNames.empty()) return;
    const std::size_t material = numberBelow(primitive.at("extras").at("materialIndex"), mesh.materialNames.size(),
                                             "names a material that is not there");
    mesh.materials.resize(mesh.triangles.size(), static_cast<std::uint16_t>(material));
  }

  template <class T>
  std::vector<T> accessor(const Json& numberInFile, const char* type, int componentType) {
    const Json& all = root_.at("accessors");
    const Json& entry = all.at(numberBelow(numberInFile, all.size(), "names an accessor that is not there"));
    require(entry.at("type") == type && entry.at("componentType") == componentType, "has an accessor of another type");
    const Json& views = root_.at("bufferViews");
    const Json& view = views.at(numberBelow(entry.at("bufferView"), views.size(), "names a view that is not there"));
    const std::size_t offset = numberBelow(view.at("byteOffset"), binary_.size() + 1, "reaches past its end");
    const std::size_t room = (binary_.size() - offset) / sizeof(T);
    std::vector<T> values(numberBelow(entry.at("count"), room + 1, "reaches past its end"));
    if (!values.empty()) std::memcpy(values.data(), binary_.data() + offset, values.size() * sizeof(T));
    return values;
  }

  Json root_;
  std::string_view binary_;
  std::map<std::size_t, std::shared_ptr<const TriangleMesh>> meshes_;
};

}  // namespace

std::vector<FrameBody> piecesFromGlb(const std::string& bytes, const std::string& fileName) {
  try {
    return GlbReader(splitChunks(bytes)).bodies();
  } catch (const BadGlb& bad) {
    throw DamagedFile(fmt::format("{}: {}; simulate again to write it anew", fileName, bad.what));
  } catch (const Json::exception& error) {
    throw DamagedFile(
        fmt::format("{}: is no glTF of this program ({}); simulate again to write it anew", fileName, error.what()));
  }
}

}  // namespace brisance
