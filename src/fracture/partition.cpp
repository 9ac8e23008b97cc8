#include "fracture/partition.h"

#include "base/check.h"
#include "base/stopwatch.h"
#include "fracture/breadth_first.h"
#include "mesh/canonical_order.h"

namespace brisance {
namespace {

/// Pieces numbered in order of their lowest node.
Partition renumbered(const Partition& partition) {
  constexpr int unseen = -1;
  std::vector<int> numberOf(partition.count, unseen);
  Partition result;
  result.pieceOf.reserve(partition.pieceOf.size());
  for (const int piece : partition.pieceOf) {
    if (numberOf[piece] == unseen) numberOf[piece] = result.count++;
    result.pieceOf.push_back(numberOf[piece]);
  }
  return result;
}

struct GraphPartitioner {
  const FractureGraph& graph;
  const FractureSettings& settings;
  Cut operator()(const BreadthFirst&) const { return {partitionBreadthFirst(graph, settings.pieces), {}, 0, 0}; }
  template <class Other>
  Cut operator()(const Other&) const {
    throw InputError("fracture: method: only breadth_first is known here");
  }
};

}  // namespace

Cut partitionGraph(const FractureGraph& graph, const FractureSettings& settings) {
  const Stopwatch watch;
  Cut cut = std::visit(GraphPartitioner{graph, settings}, settings.method);
  cut.partition = renumbered(cut.partition);
  cut.partitionSeconds = watch.seconds();
  return cut;
}

Cut partitionSurface(const TriangleMesh& surface, const FractureSettings& settings) {
  Stopwatch watch;
  const OrderedSurface ordered = inCanonicalOrder(surface);
  const FractureGraph graph = triangleGraph(ordered.mesh);
  const double graphSeconds = watch.seconds();
  Cut cut = partitionGraph(graph, settings);
  cut.graphSeconds = graphSeconds;
  std::vector<int> pieceOf(surface.triangles.size());
  for (std::size_t t = 0; t < pieceOf.size(); ++t) pieceOf[ordered.triangleOf[t]] = cut.partition.pieceOf[t];
  cut.partition.pieceOf = std::move(pieceOf);
  return cut;
}

}  // namespace brisance
