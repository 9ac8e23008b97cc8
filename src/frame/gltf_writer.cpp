#include "frame/gltf_writer.h"

#include <bit>

#include "base/check.h"

namespace brisance::gltf {

static_assert(std::endian::native == std::endian::little, "glTF, PLY and the hashes are little-endian");

namespace {

std::map<int, std::vector<Triangle>> trianglesByMaterial(const TriangleMesh& mesh) {
  if (mesh.materials.empty()) return {{0, mesh.triangles}};
  CHECK(mesh.materials.size() == mesh.triangles.size(), "{} materials for {} triangles", mesh.materials.size(),
        mesh.triangles.size());
  std::map<int, std::vector<Triangle>> groups;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) groups[mesh.materials[t]].push_back(mesh.triangles[t]);
  return groups;
}

}  // namespace

int GlbWriter::addNode(const FrameBody& body) {
  const Vec3d& p = body.pose.position;
  const Quaternion& q = body.pose.orientation;
  Json node{{"name", body.name}};
  if (const int mesh = meshNumber(body); mesh >= 0) node["mesh"] = mesh;
  node["translation"] = {p.x, p.y, p.z};
  node["rotation"] = {q.x, q.y, q.z, q.w};
  node["extras"] = {{"material", body.material}, {"moves", body.moves}};
  nodes_.push_back(std::move(node));
  return static_cast<int>(nodes_.size()) - 1;
}

/// Bodies of one mesh and one material share it. -1: nothing to see, which glTF says by having no mesh.
int GlbWriter::meshNumber(const FrameBody& body) {
  if (!body.mesh || body.mesh->triangles.empty()) return -1;
  const auto [place, isNew] =
      meshNumbers_.try_emplace({body.mesh.get(), body.material}, static_cast<int>(meshes_.size()));
  if (isNew) addMesh(*body.mesh, body);
  return place->second;
}

void GlbWriter::addMesh(const TriangleMesh& mesh, const FrameBody& body) {
  const Json attributes = addAttributes(mesh);
  Json primitives = Json::array();
  for (const auto& [material, triangles] : trianglesByMaterial(mesh)) {
    const std::string part = mesh.materials.empty() ? "" : mesh.materialNames.at(material);
    primitives.push_back({{"attributes", attributes},
                          {"indices", addIndices(triangles)},
                          {"material", materialNumber(body, part)},
                          {"extras", {{"materialIndex", material}}}});
  }
  Json entry{{"name", body.name}, {"primitives", std::move(primitives)}};
  if (!mesh.materials.empty()) entry["extras"] = {{"materialNames", mesh.materialNames}};
  meshes_.push_back(std::move(entry));
}

void GlbWriter::addShapes(int node, const std::vector<std::vector<Vec3f>>& displacements) {
  Json& mesh = meshes_.at(nodes_.at(node).at("mesh").get<int>());
  Json targets = Json::array();
  for (const std::vector<Vec3f>& displacement : displacements)
    targets.push_back({{"POSITION", addPositions(displacement)}});
  for (Json& primitive : mesh["primitives"]) primitive["targets"] = targets;
  mesh["weights"] = std::vector<int>(displacements.size(), 0);
}

Json GlbWriter::addAttributes(const TriangleMesh& mesh) {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2<float>> uvs;
  for (const Vec3d& v : mesh.vertices) positions.emplace_back(v);
  for (const Vec3d& n : mesh.normals) normals.emplace_back(n);
  // Our v runs up the picture, glTF's down.
  for (const Vec2d& uv : mesh.uvs) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(1 - uv.y)});
  Json attributes{{"POSITION", addPositions(positions)}};
  if (!normals.empty()) attributes["NORMAL"] = addAccessor(normals, vec3, float32, vertexBuffer);
  if (!uvs.empty()) attributes["TEXCOORD_0"] = addAccessor(uvs, vec2, float32, vertexBuffer);
  return attributes;
}

int GlbWriter::addPositions(const std::vector<Vec3f>& positions) {
  const int number = addAccessor(positions, vec3, float32, vertexBuffer);
  Vec3f lower = positions.front(), upper = positions.front();
  for (const Vec3f& p : positions) {
    lower = min(lower, p);
    upper = max(upper, p);
  }
  accessors_[number]["min"] = {lower.x, lower.y, lower.z};
  accessors_[number]["max"] = {upper.x, upper.y, upper.z};
  return number;
}

int GlbWriter::addIndices(const std::vector<Triangle>& triangles) {
  const int number = addAccessor(triangles, scalar, uint32, indexBuffer);
  accessors_[number]["count"] = 3 * triangles.size();
  return number;
}

int GlbWriter::addView(const void* bytes, std::size_t count, int target) {
  constexpr std::size_t alignment = 4;
  binary_.resize((binary_.size() + alignment - 1) / alignment * alignment);
  views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", count}});
  if (target != 0) views_.back()["target"] = target;
  binary_.append(static_cast<const char*>(bytes), count);
  return static_cast<int>(views_.size()) - 1;
}

std::string GlbWriter::finish() {
  Json root{{"asset", {{"version", "2.0"}, {"generator", "Brisance"}}}};
  if (!extensions_.empty()) root["extensionsUsed"] = extensions_;
  root["scene"] = 0;
  Json scene = Json::object();
  for (std::size_t n = 0; n < nodes_.size(); ++n) scene["nodes"].push_back(n);
  root["scenes"] = Json::array({std::move(scene)});
  const auto addPart = [&](const char* name, Json& part) {
    if (!part.empty()) root[name] = std::move(part);  // glTF forbids empty arrays
  };
  addPart("nodes", nodes_);
  addPart("animations", animations_);
  addPart("meshes", meshes_);
  addPart("materials", materials_);
  addPart("textures", textures_);
  addPart("images", images_);
  addPart("accessors", accessors_);
  addPart("bufferViews", views_);
  binary_.resize((binary_.size() + 3) / 4 * 4);
  if (!binary_.empty()) root["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
  // Names from foreign mesh files need not be UTF-8, which JSON insists on.
  std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return joinChunks(text, binary_);
}

}  // namespace brisance::gltf
