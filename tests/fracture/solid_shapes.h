// Small closed meshes of every kind that a cut may meet.
#pragma once

#include <map>
#include <string>

#include "assets/sample_meshes.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"

namespace brisance::solid_shapes {

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + shift, j + shift, k + shift});
  return a;
}

inline TriangleMesh shifted(TriangleMesh mesh, const Vec3d& by) {
  for (Vec3d& v : mesh.vertices) v += by;
  return mesh;
}

inline TriangleMesh turnedInsideOut(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A box with one corner at the origin, each face in n x n squares of two triangles.
inline TriangleMesh latticeBox(int n, const Vec3d& size) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> numberOf;
  const auto vertex = [&](int axis, int side, int i, int j) {
    std::array<int, 3> at{};
    at[axis] = side * n;
    at[(axis + 1) % 3] = i;
    at[(axis + 2) % 3] = j;
    const auto [place, isNew] = numberOf.try_emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (isNew) mesh.vertices.push_back({size.x * at[0] / n, size.y * at[1] / n, size.z * at[2] / n});
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const std::uint32_t a = vertex(axis, side, i, j), c = vertex(axis, side, i + 1, j + 1);
          std::uint32_t b = vertex(axis, side, i + 1, j), d = vertex(axis, side, i, j + 1);
          if (side == 0) std::swap(b, d);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
  return mesh;
}

/// A ball with two round cavities.
inline TriangleMesh hollowBall() {
  TriangleMesh mesh = samples::bumpySphere(320);
  mesh = joined(mesh, shifted(turnedInsideOut(sphereMesh(0.3, 10, false)), {0.4, 0.1, 0}));
  return joined(mesh, shifted(turnedInsideOut(sphereMesh(0.2, 8, false)), {-0.5, 0, 0.2}));
}

/// Two tetrahedra tip to tip: the tip is one place, and two vertices.
inline TriangleMesh pinched() {
  TriangleMesh mesh = cornerTetrahedron();
  TriangleMesh other = cornerTetrahedron();
  for (Vec3d& v : other.vertices) v = -v;
  return joined(mesh, turnedInsideOut(other));
}

inline std::vector<std::pair<std::string, TriangleMesh>> all() {
  return {{"box", boxMesh({1, 1, 1}, false)},
          {"ball", samples::bumpySphere(320)},
          {"plate", boxMesh({1, 1, 0.01}, false)},
          {"torus", samples::torus(400)},
          {"hollow ball", hollowBall()},
          {"two parts", joined(boxMesh({1, 1, 1}, false), shifted(sphereMesh(0.6, 12, false), {1.5, 0.2, 0.1}))},
          {"pinched", pinched()}};
}

}  // namespace brisance::solid_shapes
