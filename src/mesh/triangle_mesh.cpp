#include "mesh/triangle_mesh.h"

namespace brisance {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3d& v : mesh.vertices) box.include(v);
  return box;
}

void recenter(TriangleMesh& mesh, const Vec3d& offset) {
  for (Vec3d& v : mesh.vertices) v -= offset;
}

std::vector<Vec3d> vertexNormals(const TriangleMesh& mesh) {
  std::vector<Vec3d> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.vertices[t[0]];
    const Vec3d twiceArea = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    for (const std::uint32_t vertex : t) normals[vertex] += twiceArea;
  }
  for (Vec3d& normal : normals) normal = normalized(normal);
  return normals;
}

}  // namespace brisance
