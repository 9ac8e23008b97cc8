#include "fracture/fracture_graph.h"

#include "base/check.h"
#include "mesh/mesh_topology.h"

namespace brisance {

FractureGraph triangleGraph(const std::vector<Triangle>& triangles, std::size_t vertexCount) {
  FractureGraph graph;
  graph.first.push_back(0);
  const std::vector<Triangle> neighbours = edgeNeighbours(triangles, vertexCount);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    // Two triangles may share two edges, and a folded one touch itself: an edge of the graph is there once, between two
    // nodes.
    Triangle row = neighbours[t];
    std::sort(row.begin(), row.end());
    const auto end = std::unique(row.begin(), row.end());
    for (auto next = row.begin(); next != end; ++next)
      if (*next != noTriangle && *next != t) graph.targets.push_back(*next);
    graph.first.push_back(static_cast<std::uint32_t>(graph.targets.size()));
  }
  return graph;
}

FractureGraph triangleGraph(const TriangleMesh& mesh) { return triangleGraph(mesh.triangles, mesh.vertices.size()); }

void checkPieceCount(const FractureGraph& graph, int pieces) {
  if (graph.nodeCount() < pieces)
    throw InputError(fmt::format("fracture: pieces: must be at most the number of triangles, {}, got {}",
                                 graph.nodeCount(), pieces));
}

void numberByLowestNode(Partition& partition) {
  constexpr int none = -1;
  std::vector<int> numberOf(partition.count, none);
  int next = 0;
  for (int& piece : partition.pieceOf) {
    int& number = numberOf[piece];
    if (number == none) number = next++;
    piece = number;
  }
}

}  // namespace brisance
