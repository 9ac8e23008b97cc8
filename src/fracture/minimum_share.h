// No piece too small.
#pragma once

#include "fracture/fracture_graph.h"

namespace brisance {

/// The smallest piece, while it is smaller than `share` of the mean, joins the neighbour it holds on to most; the
/// largest piece is cut in two instead, breadth-first. Goes on until no piece is too small, or until a cut would make
/// another as small as the one that was joined. The number of pieces stays, and connected pieces stay connected.
Partition enforceMinimumShare(const FractureGraph& graph, const Partition& partition, double share);

}  // namespace brisance
