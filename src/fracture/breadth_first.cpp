#include "fracture/breadth_first.h"

#include <algorithm>
#include <queue>

#include "base/check.h"

namespace brisance {
namespace {

/// All nodes in one list, each piece a range of it.
class Splitter {
 public:
  explicit Splitter(const FractureGraph& graph)
      : graph_(graph), pieceOf_(graph.nodeCount(), unassigned), seenIn_(graph.nodeCount(), 0) {
    for (std::uint32_t node = 0; node < pieceOf_.size(); ++node)
      if (pieceOf_[node] == unassigned) addComponent(node);
  }

  void splitInto(int pieces) {
    while (static_cast<int>(ranges_.size()) < pieces) {
      const int piece = largest_.top().piece;
      largest_.pop();
      split(piece);
      enter(piece);
      enter(static_cast<int>(ranges_.size()) - 1);
    }
  }

  /// Pieces in order of their lowest node.
  Partition result() const {
    std::vector<int> numberOf(ranges_.size(), unassigned);
    Partition partition;
    for (const int piece : pieceOf_) {
      if (numberOf[piece] == unassigned) numberOf[piece] = partition.count++;
      partition.pieceOf.push_back(numberOf[piece]);
    }
    return partition;
  }

 private:
  static constexpr int unassigned = -1;
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  struct Entry {
    std::size_t size;
    int piece;
    /// The largest first; of equals the one that is older.
    bool operator<(const Entry& other) const { return size != other.size ? size < other.size : piece > other.piece; }
  };
  using Nodes = std::vector<std::uint32_t>;

  void enter(int piece) { largest_.push({ranges_[piece].size(), piece}); }

  /// Appends to `order` all nodes of the piece that are reached from `start` and not seen in this sweep, nearest first.
  void sweep(std::uint32_t start, Nodes& order) {
    const int piece = pieceOf_[start];
    std::size_t next = order.size();
    seenIn_[start] = sweep_;
    order.push_back(start);
    for (; next < order.size(); ++next)
      for (const std::uint32_t node : graph_.neighbours(order[next])) {
        if (pieceOf_[node] != piece || seenIn_[node] == sweep_) continue;
        seenIn_[node] = sweep_;
        order.push_back(node);
      }
  }
  Nodes sweepFrom(std::uint32_t start) {
    ++sweep_;
    Nodes order;
    sweep(start, order);
    return order;
  }

  void addComponent(std::uint32_t start) {
    const Nodes nodes = sweepFrom(start);
    for (const std::uint32_t node : nodes) pieceOf_[node] = static_cast<int>(ranges_.size());
    ranges_.push_back({order_.size(), order_.size() + nodes.size()});
    order_.insert(order_.end(), nodes.begin(), nodes.end());
    enter(static_cast<int>(ranges_.size()) - 1);
  }

  /// The second half of the breadth-first order without its largest island goes back to the first half.
  void split(int piece) {
    const Range range = ranges_[piece];
    const std::uint32_t any = order_[range.begin];
    const std::uint32_t end = sweepFrom(sweepFrom(any).back()).back();
    const Nodes order = sweepFrom(end);
    CHECK(order.size() == range.size() && order.size() >= 2, "piece {}: {} of {} nodes", piece, order.size(),
          range.size());
    const auto half = order.begin() + static_cast<std::ptrdiff_t>((order.size() + 1) / 2);
    const auto newPiece = static_cast<int>(ranges_.size());
    for (auto node = half; node != order.end(); ++node) pieceOf_[*node] = newPiece;
    const Nodes island = largestIsland(Nodes(half, order.end()));
    for (auto node = half; node != order.end(); ++node) pieceOf_[*node] = piece;
    for (const std::uint32_t node : island) pieceOf_[node] = newPiece;
    const auto place = order_.begin() + static_cast<std::ptrdiff_t>(range.begin);
    std::partition_copy(order.begin(), order.end(), place,
                        place + static_cast<std::ptrdiff_t>(order.size() - island.size()),
                        [&](std::uint32_t node) { return pieceOf_[node] == piece; });
    const std::size_t middle = range.end - island.size();
    ranges_[piece].end = middle;
    ranges_.push_back({middle, range.end});
  }

  /// Of nodes that are one piece by number; the first of equals.
  Nodes largestIsland(const Nodes& nodes) {
    ++sweep_;
    Nodes largest, island;
    for (const std::uint32_t node : nodes) {
      if (seenIn_[node] == sweep_) continue;
      island.clear();
      sweep(node, island);
      if (island.size() > largest.size()) std::swap(island, largest);
    }
    return largest;
  }

  const FractureGraph& graph_;
  std::vector<int> pieceOf_;
  std::vector<std::uint32_t> seenIn_;  ///< the sweep that saw the node last
  std::uint32_t sweep_ = 0;
  Nodes order_;
  std::vector<Range> ranges_;
  std::priority_queue<Entry> largest_;
};

}  // namespace

Partition partitionBreadthFirst(const FractureGraph& graph, int pieces) {
  CHECK(pieces >= 1, "pieces {}", pieces);
  if (graph.nodeCount() < pieces)
    throw InputError(fmt::format("fracture: pieces: must be at most the number of triangles, {}, got {}",
                                 graph.nodeCount(), pieces));
  Splitter splitter(graph);
  splitter.splitInto(pieces);
  return splitter.result();
}

}  // namespace brisance
