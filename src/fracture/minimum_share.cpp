#include "fracture/minimum_share.h"

#include <map>
#include <set>

#include "fracture/breadth_first.h"
#include "fracture/sub_graph.h"

namespace brisance {
namespace {

class Exchange {
 public:
  Exchange(const FractureGraph& graph, Partition partition)
      : graph_(graph),
        partition_(std::move(partition)),
        nodesOf_(partition_.count),
        sizeOf_(partition_.count, 0),
        sweep_(static_cast<std::uint32_t>(graph.nodeCount())) {
    for (std::uint32_t node = 0; node < partition_.pieceOf.size(); ++node) {
      const int piece = partition_.pieceOf[node];
      nodesOf_[piece].push_back(node);
      sizeOf_[piece] += size(node);
      total_ += size(node);
    }
    for (int piece = 0; piece < partition_.count; ++piece) bySize_.insert({sizeOf_[piece], piece});
  }

  void run(double share) {
    const double least = share * total_ / partition_.count;
    for (auto small = bySize_.begin(); small != bySize_.end() && small->first < least;) {
      // One that nothing holds on to stays as it is.
      if (exchange(small->second))
        small = bySize_.begin();
      else
        ++small;
    }
  }

  Partition result() && {
    numberByLowestNode(partition_);
    return std::move(partition_);
  }

 private:
  static constexpr int none = -1;
  using Nodes = std::vector<std::uint32_t>;

  double size(std::uint32_t node) const { return graph_.sizes.empty() ? 1 : graph_.sizes[node]; }

  /// Whether `small` was joined to a neighbour, and its number given to half of the largest piece.
  bool exchange(int small) {
    const int neighbour = strongestNeighbour(small);
    if (neighbour == none) return false;
    const double joined = sizeOf_[small] + sizeOf_[neighbour];
    const int largest = joined > bySize_.rbegin()->first ? neighbour : bySize_.rbegin()->second;
    Nodes nodes = nodesOf_[largest];
    if (largest == neighbour) nodes.insert(nodes.end(), nodesOf_[small].begin(), nodesOf_[small].end());
    const Nodes half = halfOf(nodes);
    double halfSize = 0;
    for (const std::uint32_t node : half) halfSize += size(node);
    const double otherSize = (largest == neighbour ? joined : sizeOf_[largest]) - halfSize;
    if (half.empty() || std::min(halfSize, otherSize) <= sizeOf_[small]) return false;
    give(nodesOf_[small], small, neighbour);
    give(half, largest, small);
    return true;
  }

  int strongestNeighbour(int piece) const {
    std::map<int, double> shared;
    for (const std::uint32_t node : nodesOf_[piece])
      for (std::uint32_t e = graph_.first[node]; e < graph_.first[node + 1]; ++e) {
        const int other = partition_.pieceOf[graph_.targets[e]];
        if (other != piece) shared[other] += graph_.weights.empty() ? 1 : graph_.weights[e];
      }
    int strongest = none;
    for (const auto& [other, weight] : shared)
      if (strongest == none || weight > shared[strongest]) strongest = other;
    return strongest;
  }

  /// Nothing where the nodes are not one island.
  Nodes halfOf(const Nodes& nodes) {
    for (const std::uint32_t node : nodes) sweep_.open(node);
    Nodes half;
    if (sweep_.from(nodes.front(), graph_) == nodes.size() && nodes.size() > 1)
      half = breadthFirstHalf(sweep_.part(graph_));
    sweep_.closeAll();
    for (const std::uint32_t node : nodes) sweep_.close(node);
    return half;
  }

  void give(const Nodes& given, int from, int to) {
    bySize_.erase({sizeOf_[from], from});
    bySize_.erase({sizeOf_[to], to});
    for (const std::uint32_t node : given) {
      partition_.pieceOf[node] = to;
      nodesOf_[to].push_back(node);
      sizeOf_[from] -= size(node);
      sizeOf_[to] += size(node);
    }
    std::erase_if(nodesOf_[from], [&](std::uint32_t node) { return partition_.pieceOf[node] != from; });
    bySize_.insert({sizeOf_[from], from});
    bySize_.insert({sizeOf_[to], to});
  }

  const FractureGraph& graph_;
  Partition partition_;
  std::vector<Nodes> nodesOf_;
  std::vector<double> sizeOf_;
  std::set<std::pair<double, int>> bySize_;
  Sweep sweep_;
  double total_ = 0;
};

}  // namespace

Partition enforceMinimumShare(const FractureGraph& graph, const Partition& partition, double share) {
  Exchange exchange(graph, partition);
  exchange.run(share);
  return std::move(exchange).result();
}

}  // namespace brisance
