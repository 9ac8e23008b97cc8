// The parts of a graph that nothing joins.
#pragma once

#include "fracture/sub_graph.h"

namespace brisance {

/// The connected parts in order of their lowest node, each in breadth-first order from there.
std::vector<SubGraph> componentsOf(const FractureGraph& graph);

/// How many pieces each part becomes: one, and the others one by one to the part that has most size for each of its
/// pieces, but never more than it has nodes. More than `pieces` where there are more parts.
std::vector<int> sharePieces(const std::vector<SubGraph>& parts, int pieces);

}  // namespace brisance
