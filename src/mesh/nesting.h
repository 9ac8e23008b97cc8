// Which parts of a surface are turned the wrong way.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

struct Turning {
  std::vector<bool> turn;    ///< per part: its triangles have to be turned over
  std::vector<bool> inside;  ///< per part: it lies inside an odd number of others, so it bounds a cavity
  bool judged = true;        ///< false: too many overlap to tell which lie inside which; none is taken for a cavity
};

/// Of parts that are each closed and turned one way: outward where they bound a solid, inward where they bound a
/// cavity of one. `partOf` per triangle; noTriangle: not closed, and left alone.
Turning turningOf(const TriangleMesh& surface, const std::vector<std::uint32_t>& partOf, std::size_t parts);

}  // namespace brisance
