// A solid as a few convex ones that cover it.
#pragma once

#include "mesh/convex_solid.h"

namespace brisance {

struct ConvexPartsSettings {
  std::size_t most = 16;  ///< parts
  double excess = 0.03;   ///< volume of the parts beyond that of the mesh, relative to it, that is good enough
};

/// A convex mesh is one part. Any other is halved along the axes where that saves most volume, part by part, and each
/// part is the hull of the surface in it: the parts cover the mesh, and stand out beyond it only across hollows.
std::vector<ConvexSolid> convexParts(const TriangleMesh& mesh, const ConvexPartsSettings& settings = {});

}  // namespace brisance
