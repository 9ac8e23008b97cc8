// Triangles whose corners name positions, texture coordinates and normals apart, as several file formats do.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

constexpr std::uint32_t notGiven = 0xFFFFFFFFu;

/// Numbers from 0; `notGiven` where the file names none.
struct Corner {
  std::uint32_t position = notGiven, uv = notGiven, normal = notGiven;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct CornerMesh {
  std::vector<Vec3d> positions, normals;
  std::vector<Vec2d> uvs;
  std::vector<std::array<Corner, 3>> triangles;
  std::vector<std::uint16_t> materials;
  std::vector<std::string> materialNames;
};

/// A vertex for each way in which a position is used: it keeps its number for the first, further ones follow all
/// positions. Every corner has a position in range.
TriangleMesh withSharedVertices(CornerMesh content);

/// Gives each vertex without a normal the mean over its triangles, by area; none where they have no area.
void makeUpNormals(TriangleMesh& mesh, const std::vector<bool>& given);

}  // namespace brisance
