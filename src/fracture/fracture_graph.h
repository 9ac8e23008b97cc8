// What every partitioner works on.
#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Undirected graph in compressed rows: the neighbours of node i are targets[first[i]] .. targets[first[i + 1]].
struct FractureGraph {
  std::vector<std::uint32_t> first;    ///< node count + 1 entries
  std::vector<std::uint32_t> targets;  ///< each edge twice
  std::vector<double> weights;         ///< per entry of targets, above 0: the strength of the edge; empty: all one
  std::vector<double> sizes;           ///< per node: triangles, area or volume; empty: all one
  std::vector<Vec3d> places;           ///< per node [m], for cells of space; may be empty
  int nodeCount() const { return static_cast<int>(first.size()) - 1; }
  std::span<const std::uint32_t> neighbours(std::uint32_t node) const {
    return {targets.data() + first[node], first[node + 1] - first[node]};
  }
};

/// Nodes are triangles; neighbours share an edge.
FractureGraph triangleGraph(const TriangleMesh& mesh);
FractureGraph triangleGraph(const std::vector<Triangle>& triangles, std::size_t vertexCount);

/// One piece number per node, pieces numbered 0 .. count - 1.
struct Partition {
  std::vector<int> pieceOf;
  int count = 0;
};

/// Throws InputError if there are fewer nodes than pieces.
void checkPieceCount(const FractureGraph& graph, int pieces);

/// Numbers pieces in order of their lowest node.
void numberByLowestNode(Partition& partition);

}  // namespace brisance
