// Small meshes that several tests look at.
#pragma once

#include "mesh/mesh_topology.h"

namespace brisance {

/// Corners at the origin and at one metre along each axis: volume 1/6 m3.
inline TriangleMesh cornerTetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Pose& pose) {
  for (Vec3d& v : mesh.vertices) v = pose * v;
  return mesh;
}

inline TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3d& v : mesh.vertices) v.x = -v.x;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// The same surface with one triangle split in three at an inner point: `share` of the way to its corners a, b, c.
inline TriangleMesh withTriangleSplit(TriangleMesh mesh, std::size_t triangle, const Vec3d& share) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[a] * share.x + mesh.vertices[b] * share.y + mesh.vertices[c] * share.z);
  mesh.triangles[triangle] = {a, b, middle};
  mesh.triangles.push_back({b, c, middle});
  mesh.triangles.push_back({c, a, middle});
  return mesh;
}

inline double largestDifference(const Mat3& a, const Mat3& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a.row[i][j] - b.row[i][j]));
  return largest;
}

}  // namespace brisance
