// Where a surface cuts through itself.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

struct SelfCrossing {
  std::size_t pairs = 0;       ///< of triangles that clearly cut through each other
  bool all = true;             ///< false: the search ended early, there may be more
  std::uint32_t triangle = 0;  ///< the lowest that is cut
};

/// Triangles that share an edge are not compared; such that touch, or overlap within one plane, do not cross. The time
/// is bounded, however wild the mesh. `surface` has one vertex per place.
SelfCrossing selfCrossing(const TriangleMesh& surface);

/// Box of a triangle.
Box3 boxOf(const TriangleMesh& mesh, const Triangle& t);

}  // namespace brisance
