// Coarser and coarser pictures of a weighted graph (algebraic multigrid by aggregation).
#pragma once

#include "base/aligned.h"
#include "fracture/fracture_graph.h"

namespace brisance {

/// Rows of a graph's Laplacian: (L x)_i = sum over the entries of row i of weight (x_i - x_target).
struct LaplacianRows {
  AlignedVector<std::uint32_t> first, targets;
  AlignedVector<float> weights;
  AlignedVector<float> diagonal;  ///< sum of a row's weights
  std::uint32_t size() const { return static_cast<std::uint32_t>(diagonal.size()); }
};

/// One level. Its rows are smoothed in fixed blocks, each by one thread: an entry is below its row in the same block,
/// above it in the same block, or outside the block, and rows hold the three kinds in this order.
struct GraphLevel {
  LaplacianRows rows;
  AlignedVector<std::uint32_t> belowEnd, insideEnd;  ///< per row, where its entries below and those inside end
  std::uint32_t blockRows = 1;
  AlignedVector<float> mass;                          ///< per node, how many nodes of the finest level it stands for
  AlignedVector<std::uint32_t> aggregateOf;           ///< node on the next level; empty on the coarsest
  AlignedVector<std::uint32_t> memberFirst, members;  ///< nodes of each aggregate
};

/// Levels from the graph itself down to `coarsestSize` nodes or fewer: on each, nodes are paired twice over along their
/// strongest edges, and an unpaired one joins a neighbour's aggregate. (Notay 2010, "An aggregation-based algebraic
/// multigrid method".)
struct GraphMultigrid {
  explicit GraphMultigrid(const FractureGraph& graph);
  static constexpr std::uint32_t coarsestSize = 64;
  std::vector<GraphLevel> levels;
  std::vector<float> coarsestInverse;  ///< pseudo-inverse of the coarsest Laplacian, by rows
};

}  // namespace brisance
