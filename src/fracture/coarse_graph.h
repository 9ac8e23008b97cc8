// A partitioned graph made coarser step by step: pairs of neighbours within a piece become one node.
#pragma once

#include "fracture/fracture_graph.h"
#include "fracture/sub_graph.h"

namespace brisance {

using Amounts = std::vector<float, Unset<float, tbb::scalable_allocator>>;

/// One level: each node lies in one piece, and a piece's nodes have consecutive numbers where the level is made.
/// Single precision: weights and sizes are relative to their means, and only compared.
struct CoarseLevel {
  Numbers first, targets;
  Amounts weights;                        ///< per entry of targets
  Amounts sizes;                          ///< per node
  std::vector<std::uint32_t> pieceBegin;  ///< per piece its lowest node, and one past the last
  Numbers coarse;                         ///< node -> node of the next coarser level; empty at the coarsest
  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(sizes.size()); }
};

/// The graph with nodes sorted by their piece; `names` becomes the old number of each node.
CoarseLevel finestLevel(const FractureGraph& graph, const Partition& partition, Numbers& names);

/// Pairs neighbours within pieces by heavy edges (Karypis & Kumar 1998; rated by weight^2 / sizes as Holtgrewe, Sanders
/// & Schulz 2010), none heavier than `largestSize`. Fills `finer.coarse`.
CoarseLevel coarser(CoarseLevel& finer, double largestSize);

}  // namespace brisance
