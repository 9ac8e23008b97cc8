// Recursive breadth-first partition (thesis 4.2.1, Algorithm 5; the connected variant for any number of pieces).
#pragma once

#include "fracture/fracture_graph.h"

namespace brisance {

/// Splits the largest piece until there are `pieces`: starts at a far end (two sweeps), halves the list in
/// breadth-first order, hands stray islands of the second half back to the first. Every piece is connected; exactly
/// `pieces` come out (a graph with more components than that keeps its components). Throws InputError if there are
/// fewer nodes than pieces.
Partition partitionBreadthFirst(const FractureGraph& graph, int pieces);

}  // namespace brisance
