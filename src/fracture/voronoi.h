// Cells of seeded points, on a graph whose nodes have places.
#pragma once

#include "fracture/fracture_graph.h"
#include "fracture/fracture_settings.h"

namespace brisance {

/// Every node goes to the nearest of seeded points (`crowdedPoints` among the nodes' places); islands of a cell but its
/// largest join the neighbours they hold on to most. Each connected part of the graph has seeds of its own: exactly
/// `pieces` connected pieces come out (a graph with more parts than that keeps its parts). Throws InputError if there
/// are fewer nodes than pieces.
Partition partitionVoronoi(const FractureGraph& graph, int pieces, const Voronoi& cells, std::uint64_t seed);

/// Islands of a piece, all but its largest, join the neighbour piece that they share most weight with. Pieces that
/// touch nothing else stay as they are.
void joinStrayIslands(const FractureGraph& graph, Partition& partition);

}  // namespace brisance
