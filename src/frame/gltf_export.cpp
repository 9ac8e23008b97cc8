#include "frame/gltf_export.h"

#include <bit>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/check.h"
#include "frame/gltf_format.h"

namespace brisance {

static_assert(std::endian::native == std::endian::little, "glTF, PLY and the hashes are little-endian");

namespace {

using Json = nlohmann::ordered_json;

/// Gathers one glTF: the JSON parts by name, and the binary chunk.
class GlbWriter {
 public:
  std::string write(const std::vector<FrameBody>& bodies) {
    for (const FrameBody& body : bodies) addNode(body);
    return assemble();
  }

 private:
  void addNode(const FrameBody& body) {
    const Vec3d& p = body.pose.position;
    const Quaternion& q = body.pose.orientation;
    Json node{{"name", body.name}};
    if (const int mesh = meshNumber(body); mesh >= 0) node["mesh"] = mesh;
    node["translation"] = {p.x, p.y, p.z};
    node["rotation"] = {q.x, q.y, q.z, q.w};
    node["extras"] = {{"material", body.material}, {"moves", body.moves}};
    nodes_.push_back(std::move(node));
  }

  /// Bodies of one mesh and one material share it. -1: nothing to see, which glTF says by having no mesh.
  int meshNumber(const FrameBody& body) {
    if (!body.mesh || body.mesh->triangles.empty()) return -1;
    const auto [place, isNew] =
        meshNumbers_.try_emplace({body.mesh.get(), body.material}, static_cast<int>(meshes_.size()));
    if (isNew) addMesh(*body.mesh, body);
    return place->second;
  }

  void addMesh(const TriangleMesh& mesh, const FrameBody& body) {
    const Json attributes = addAttributes(mesh);
    Json primitives = Json::array();
    for (const auto& [material, triangles] : trianglesByMaterial(mesh)) {
      const std::string& name = mesh.materials.empty() ? body.material : mesh.materialNames.at(material);
      primitives.push_back({{"attributes", attributes},
                            {"indices", addIndices(triangles)},
                            {"material", materialNumber(name)},
                            {"extras", {{"materialIndex", material}}}});
    }
    Json entry{{"name", body.name}, {"primitives", std::move(primitives)}};
    if (!mesh.materials.empty()) entry["extras"] = {{"materialNames", mesh.materialNames}};
    meshes_.push_back(std::move(entry));
  }

  static std::map<int, std::vector<Triangle>> trianglesByMaterial(const TriangleMesh& mesh) {
    if (mesh.materials.empty()) return {{0, mesh.triangles}};
    CHECK(mesh.materials.size() == mesh.triangles.size(), "{} materials for {} triangles", mesh.materials.size(),
          mesh.triangles.size());
    std::map<int, std::vector<Triangle>> groups;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) groups[mesh.materials[t]].push_back(mesh.triangles[t]);
    return groups;
  }

  Json addAttributes(const TriangleMesh& mesh) {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2<float>> uvs;
    for (const Vec3d& v : mesh.vertices) positions.emplace_back(v);
    for (const Vec3d& n : mesh.normals) normals.emplace_back(n);
    // Our v runs up the picture, glTF's down.
    for (const Vec2d& uv : mesh.uvs) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(1 - uv.y)});
    Json attributes{{"POSITION", addPositions(positions)}};
    if (!normals.empty()) attributes["NORMAL"] = addAccessor(normals, gltf::vec3, gltf::float32, gltf::vertexBuffer);
    if (!uvs.empty()) attributes["TEXCOORD_0"] = addAccessor(uvs, gltf::vec2, gltf::float32, gltf::vertexBuffer);
    return attributes;
  }

  int addPositions(const std::vector<Vec3f>& positions) {
    const int number = addAccessor(positions, gltf::vec3, gltf::float32, gltf::vertexBuffer);
    Vec3f lower = positions.front(), upper = positions.front();
    for (const Vec3f& p : positions) {
      lower = min(lower, p);
      upper = max(upper, p);
    }
    accessors_[number]["min"] = {lower.x, lower.y, lower.z};
    accessors_[number]["max"] = {upper.x, upper.y, upper.z};
    return number;
  }

  int addIndices(const std::vector<Triangle>& triangles) {
    const int number = addAccessor(triangles, gltf::scalar, gltf::uint32, gltf::indexBuffer);
    accessors_[number]["count"] = 3 * triangles.size();
    return number;
  }

  /// Each accessor has a view of its own; all numbers are four bytes, so everything stays aligned.
  template <class T>
  int addAccessor(const std::vector<T>& values, const char* type, int componentType, int target) {
    const std::size_t bytes = values.size() * sizeof(T);
    views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
    binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", componentType},
                          {"count", values.size()},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }

  int materialNumber(const std::string& name) {
    const auto [place, isNew] = materialNumbers_.try_emplace(name, static_cast<int>(materials_.size()));
    if (isNew) materials_.push_back({{"name", name}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}});
    return place->second;
  }

  std::string assemble() {
    Json root{{"asset", {{"version", "2.0"}, {"generator", "Brisance"}}}, {"scene", 0}};
    Json scene = Json::object();
    for (std::size_t n = 0; n < nodes_.size(); ++n) scene["nodes"].push_back(n);
    root["scenes"] = Json::array({std::move(scene)});
    const auto addPart = [&](const char* name, Json& part) {
      if (!part.empty()) root[name] = std::move(part);  // glTF forbids empty arrays
    };
    addPart("nodes", nodes_);
    addPart("meshes", meshes_);
    addPart("materials", materials_);
    addPart("accessors", accessors_);
    addPart("bufferViews", views_);
    if (!binary_.empty()) root["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
    // Names from foreign mesh files need not be UTF-8, which JSON insists on.
    std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return gltf::joinChunks(text, binary_);
  }

  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(), accessors_ = Json::array(),
       views_ = Json::array();
  std::string binary_;
  std::map<std::pair<const TriangleMesh*, std::string>, int> meshNumbers_;
  std::map<std::string, int> materialNumbers_;
};

}  // namespace

std::string piecesToGlb(const std::vector<FrameBody>& bodies) { return GlbWriter().write(bodies); }

}  // namespace brisance
