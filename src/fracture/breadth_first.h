// Breadth-first partitions: the connected one for any number of pieces, and the thesis' own (4.2.1, Algorithm 5).
#pragma once

#include <optional>

#include "fracture/fracture_graph.h"
#include "fracture/fracture_settings.h"

namespace brisance {

struct SubGraph;

/// Starts at a far end of the graph (two sweeps), cuts the breadth-first order in proportion to the pieces that each
/// side is to become, hands stray islands of the second side back to the first, and goes on in both sides. Every piece
/// is connected; exactly `pieces` come out (a graph with more components than that keeps its components). Sides get
/// pieces by what they really hold, so that any number of pieces comes out even; halving the largest piece again and
/// again would leave pieces of twice the size of others unless the number is a power of two, where both are alike.
/// Sides are independent: they are cut on several threads, with the same result. Throws InputError if there are fewer
/// nodes than pieces.
Partition partitionBreadthFirst(const FractureGraph& graph, int pieces);

/// Two connected sides of a connected part of a graph; the second side's nodes, by their numbers in the whole graph.
std::vector<std::uint32_t> breadthFirstHalf(const SubGraph& part);

/// Algorithm 5 as printed: triangles that share a vertex are neighbours; the list of each piece, in breadth-first order
/// from its first triangle, is cut in two, until there are `pieces`, a power of two. `list` cuts it in the middle;
/// `level` behind the last triangle of level L = maxLevel / 2 (rounded down), or the nearest place that leaves either
/// side as many triangles as it is to become pieces. Triangles that the search does not reach go to the list's end, as
/// the thesis' fix has it: none is ever lost, but pieces may be several islands. With `rootSeed` each search starts at
/// a random triangle instead. Throws InputError if `pieces` is no power of two or above the number of triangles.
Partition partitionBreadthFirstThesis(const TriangleMesh& mesh, int pieces, ThesisSplit split,
                                      std::optional<std::uint64_t> rootSeed = std::nullopt);

}  // namespace brisance
