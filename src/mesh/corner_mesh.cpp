#include "mesh/corner_mesh.h"

#include "mesh/number_table.h"

namespace brisance {
namespace {

std::uint64_t hashOf(const Corner& corner) { return mixHash(mixHash(corner.position, corner.uv), corner.normal); }

class VertexSplitter {
 public:
  explicit VertexSplitter(CornerMesh& content) : content_(content), cornerOf_(content.positions.size()) {
    mesh_.vertices = std::move(content.positions);
  }

  TriangleMesh build() {
    mesh_.triangles.reserve(content_.triangles.size());
    for (const auto& corners : content_.triangles)
      mesh_.triangles.push_back({vertexOf(corners[0]), vertexOf(corners[1]), vertexOf(corners[2])});
    mesh_.materials = std::move(content_.materials);
    mesh_.materialNames = std::move(content_.materialNames);
    if (!content_.uvs.empty()) gatherUvs();
    if (!content_.normals.empty()) gatherNormals();
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertexOf(const Corner& corner) {
    Corner& first = cornerOf_[corner.position];
    if (first.position == notGiven) first = corner;
    if (first == corner) return corner.position;
    const auto fresh = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::uint32_t vertex =
        copies_.findOrAdd(hashOf(corner), fresh, [&](std::uint32_t other) { return cornerOf_[other] == corner; });
    if (vertex == fresh) {
      mesh_.vertices.push_back(Vec3d(mesh_.vertices[corner.position]));
      cornerOf_.push_back(corner);
    }
    return vertex;
  }

  void gatherUvs() {
    mesh_.uvs.reserve(cornerOf_.size());
    for (const Corner& corner : cornerOf_)
      mesh_.uvs.push_back(corner.uv == notGiven ? Vec2d{} : content_.uvs[corner.uv]);
  }

  void gatherNormals() {
    mesh_.normals.reserve(cornerOf_.size());
    for (const Corner& corner : cornerOf_)
      mesh_.normals.push_back(corner.normal == notGiven ? Vec3d{} : content_.normals[corner.normal]);
    std::vector<bool> given(mesh_.normals.size());
    for (std::size_t v = 0; v < given.size(); ++v) given[v] = mesh_.normals[v] != Vec3d{};
    makeUpNormals(mesh_, given);
  }

  CornerMesh& content_;
  TriangleMesh mesh_;
  std::vector<Corner> cornerOf_;  ///< per vertex
  NumberTable copies_;
};

}  // namespace

TriangleMesh withSharedVertices(CornerMesh content) { return VertexSplitter(content).build(); }

void makeUpNormals(TriangleMesh& mesh, const std::vector<bool>& given) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d& origin = mesh.vertices[a];
    const Vec3d doubleArea = cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin);
    for (const std::uint32_t v : {a, b, c})
      if (!given[v]) mesh.normals[v] += doubleArea;
  }
  for (std::size_t v = 0; v < given.size(); ++v) {
    if (given[v]) continue;
    const bool hasLength = std::isfinite(length(mesh.normals[v]));  // areas of huge triangles overflow
    mesh.normals[v] = hasLength ? normalized(mesh.normals[v]) : Vec3d{};
  }
}

}  // namespace brisance
