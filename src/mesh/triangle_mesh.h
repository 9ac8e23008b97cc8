// Triangles, and what every floor above may know of a shape.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math.h"

namespace brisance {

using Triangle = std::array<std::uint32_t, 3>;  ///< vertex numbers, counter-clockwise seen from outside

struct TriangleMesh {
  std::vector<Vec3d> vertices;  ///< [m]
  std::vector<Triangle> triangles;
  std::vector<Vec3d> normals;            ///< per vertex for smooth shading, or empty
  std::vector<Vec2d> uvs;                ///< per vertex, (0, 0) lower left of the picture, or empty
  std::vector<std::uint16_t> materials;  ///< per triangle, index into materialNames, or empty
  std::vector<std::string> materialNames;
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

Box3 bounds(const TriangleMesh& mesh);
/// Unit normals of the vertices, weighted by the area of the faces around them (Algorithm 8 in one pass over the
/// faces).
std::vector<Vec3d> vertexNormals(const TriangleMesh& mesh);
/// Every vertex moved by -offset.
void recenter(TriangleMesh& mesh, const Vec3d& offset);

}  // namespace brisance
