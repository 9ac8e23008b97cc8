// An order of a mesh's parts that its file had no say in.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

struct OrderedSurface {
  TriangleMesh mesh;                      ///< vertices and triangles only; unused vertices are left out
  std::vector<std::uint32_t> triangleOf;  ///< per triangle, its number in the mesh it came from
};

/// The same surface with vertices along a Morton curve (Morton 1966) and triangles by their vertices, each beginning at
/// its lowest: a mesh whose lists were scrambled comes out the same, and neighbours lie close in memory. Only vertices
/// at exactly the same place keep the order they came in.
OrderedSurface inCanonicalOrder(const TriangleMesh& mesh);

}  // namespace brisance
