#include "fracture/voronoi.h"

#include <map>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/cell_seeds.h"
#include "fracture/components.h"
#include "fracture/nearest_point.h"

namespace brisance {
namespace {

using Nodes = std::vector<std::uint32_t>;

/// A part's nodes in the graph's own order.
Nodes nodesOf(const SubGraph& part, const FractureGraph& graph) {
  Nodes nodes(part.nodeCount());
  if (static_cast<int>(nodes.size()) == graph.nodeCount()) {
    std::iota(nodes.begin(), nodes.end(), 0u);
  } else {
    std::copy(part.names.begin(), part.names.end(), nodes.begin());
    std::sort(nodes.begin(), nodes.end());
  }
  return nodes;
}

template <class Value>
std::vector<Value> valuesOf(const Nodes& nodes, const std::vector<Value>& values) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(nodes.size());
  for (const std::uint32_t node : nodes) result.push_back(values[node]);
  return result;
}

/// Cells first, first + 1, ... around some of the nodes of one part.
void growCells(const FractureGraph& graph, const Nodes& nodes, const std::vector<std::uint32_t>& seeds, int first,
               std::vector<int>& pieceOf) {
  std::vector<PointTree::Entry> entries;
  for (std::uint32_t cell = 0; cell < seeds.size(); ++cell) entries.push_back({graph.places[nodes[seeds[cell]]], cell});
  const PointTree tree(std::move(entries));
  constexpr std::int64_t perTask = 8192;
  parallelFor(0, std::ssize(nodes), perTask, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      Nearest nearest;
      tree.search(graph.places[nodes[i]], nearest);
      pieceOf[nodes[i]] = first + static_cast<int>(nearest.id);
    }
  });
  // Where two nodes lie on one point, each may be a seed: no cell is left empty.
  for (std::uint32_t cell = 0; cell < seeds.size(); ++cell)
    pieceOf[nodes[seeds[cell]]] = first + static_cast<int>(cell);
}

/// All islands of all pieces.
struct Islands {
  std::vector<Nodes> nodes;
  std::vector<double> size;
  std::vector<int> piece;
};

class IslandSearch {
 public:
  IslandSearch(const FractureGraph& graph, const Partition& partition)
      : graph_(graph), partition_(partition), seen_(graph.nodeCount(), false) {}

  Islands all() {
    Islands islands;
    for (std::uint32_t node = 0; node < seen_.size(); ++node) {
      if (seen_[node]) continue;
      islands.nodes.push_back(islandOf(node));
      islands.piece.push_back(partition_.pieceOf[node]);
      double size = 0;
      for (const std::uint32_t member : islands.nodes.back()) size += graph_.sizes.empty() ? 1 : graph_.sizes[member];
      islands.size.push_back(size);
    }
    return islands;
  }

 private:
  Nodes islandOf(std::uint32_t start) {
    Nodes nodes{start};
    seen_[start] = true;
    for (std::size_t next = 0; next < nodes.size(); ++next)
      for (const std::uint32_t node : graph_.neighbours(nodes[next])) {
        if (seen_[node] || partition_.pieceOf[node] != partition_.pieceOf[start]) continue;
        seen_[node] = true;
        nodes.push_back(node);
      }
    return nodes;
  }

  const FractureGraph& graph_;
  const Partition& partition_;
  std::vector<bool> seen_;
};

/// The islands that are not the largest of their piece (of equals the first is the largest).
std::vector<std::size_t> strays(const Islands& islands, int pieces) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> largest(pieces, none);
  for (std::size_t i = 0; i < islands.nodes.size(); ++i) {
    std::size_t& best = largest[islands.piece[i]];
    if (best == none || islands.size[i] > islands.size[best]) best = i;
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < islands.nodes.size(); ++i)
    if (largest[islands.piece[i]] != i) result.push_back(i);
  return result;
}

constexpr int astray = -1;

/// The piece around an island that shares most weight with it; astray where there is none.
int strongestAround(const FractureGraph& graph, const std::vector<int>& pieceOf, const Nodes& island) {
  std::map<int, double> shared;
  for (const std::uint32_t node : island)
    for (std::uint32_t e = graph.first[node]; e < graph.first[node + 1]; ++e)
      if (pieceOf[graph.targets[e]] != astray)
        shared[pieceOf[graph.targets[e]]] += graph.weights.empty() ? 1 : graph.weights[e];
  int strongest = astray;
  for (const auto& [piece, weight] : shared)
    if (strongest == astray || weight > shared[strongest]) strongest = piece;
  return strongest;
}

}  // namespace

void joinStrayIslands(const FractureGraph& graph, Partition& partition) {
  const Islands islands = IslandSearch(graph, partition).all();
  std::vector<std::size_t> left = strays(islands, partition.count);
  const auto assign = [&](std::size_t island, int piece) {
    for (const std::uint32_t node : islands.nodes[island]) partition.pieceOf[node] = piece;
  };
  for (const std::size_t island : left) assign(island, astray);
  // An island among islands waits until one of them has joined.
  for (std::size_t before = left.size() + 1; left.size() < before;) {
    before = left.size();
    std::erase_if(left, [&](std::size_t island) {
      const int piece = strongestAround(graph, partition.pieceOf, islands.nodes[island]);
      if (piece != astray) assign(island, piece);
      return piece != astray;
    });
  }
  for (const std::size_t island : left) assign(island, islands.piece[island]);
}

Partition partitionVoronoi(const FractureGraph& graph, int pieces, const Voronoi& cells, std::uint64_t seed) {
  CHECK(pieces >= 1, "pieces {}", pieces);
  CHECK(static_cast<int>(graph.places.size()) == graph.nodeCount(), "{} places of {} nodes", graph.places.size(),
        graph.nodeCount());
  checkPieceCount(graph, pieces);
  const std::vector<SubGraph> parts = componentsOf(graph);
  const std::vector<int> shares = sharePieces(parts, pieces);
  Partition partition{std::vector<int>(graph.nodeCount()), 0};
  for (std::size_t i = 0; i < parts.size(); partition.count += shares[i++]) {
    const Nodes nodes = nodesOf(parts[i], graph);
    const std::vector<std::uint32_t> seeds =
        crowdedPoints(valuesOf(nodes, graph.places), valuesOf(nodes, graph.sizes), shares[i], cells, seed + i);
    growCells(graph, nodes, seeds, partition.count, partition.pieceOf);
  }
  joinStrayIslands(graph, partition);
  numberByLowestNode(partition);
  return partition;
}

}  // namespace brisance
