// Breaking by name: from settings to pieces.
#pragma once

#include <string_view>
#include <vector>

#include "fracture/fracture_graph.h"
#include "fracture/fracture_settings.h"

namespace brisance {

/// Names of the alternatives of FractureMethod, in their order: those of the scene file and the command line.
inline constexpr std::string_view fractureMethodNames[] = {"breadth_first", "breadth_first_thesis", "curvature",
                                                           "spectral", "voronoi"};

struct Cut {
  Partition partition = {};
  std::vector<double> eigenvalues = {};  ///< of the first spectral cut: 0, and the smallest others; else empty
  double graphSeconds = 0, partitionSeconds = 0;
};

/// Piece of each triangle of a surface. Pieces are numbered along the surface's canonical order, so that neither the
/// order of its lists nor the number of threads changes anything. Throws InputError naming what the settings ask too
/// much of.
Cut partitionSurface(const TriangleMesh& surface, const FractureSettings& settings);

/// Piece of each node of any graph: of a solid's cells, whose places and sizes it has.
Cut partitionGraph(const FractureGraph& graph, const FractureSettings& settings);

}  // namespace brisance
