#include "fracture/fracture_graph.h"

#include <numeric>

#include "base/check.h"
#include "base/parallel.h"
#include "mesh/mesh_topology.h"

namespace brisance {

namespace {

/// The other triangles among a triangle's neighbours, each once: two triangles may share two edges, and a folded one
/// touch itself.
struct Row {
  Triangle targets{};
  std::uint32_t count = 0;
};

Row rowOf(std::uint32_t triangle, Triangle neighbours) {
  std::sort(neighbours.begin(), neighbours.end());
  Row row;
  for (const std::uint32_t next : neighbours)
    if (next != noTriangle && next != triangle && (row.count == 0 || row.targets[row.count - 1] != next))
      row.targets[row.count++] = next;
  return row;
}

}  // namespace

FractureGraph triangleGraph(const std::vector<Triangle>& triangles, std::size_t vertexCount) {
  constexpr std::int64_t perTask = 32768;
  const auto count = static_cast<std::int64_t>(triangles.size());
  const std::vector<Triangle> neighbours = edgeNeighbours(triangles, vertexCount);
  const auto row = [&](std::int64_t t) { return rowOf(static_cast<std::uint32_t>(t), neighbours[t]); };
  FractureGraph graph;
  graph.first.assign(count + 1, 0);
  parallelFor(0, count, perTask, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) graph.first[t + 1] = row(t).count;
  });
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.targets.resize(graph.first.back());
  parallelFor(0, count, perTask, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      const Row r = row(t);
      std::copy_n(r.targets.begin(), r.count, graph.targets.begin() + graph.first[t]);
    }
  });
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
