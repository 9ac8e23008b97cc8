#include "fracture/breadth_first.h"

#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/components.h"

namespace brisance {
namespace {

/// How many nodes from the start hold first / pieces of the size; enough nodes on either side for its pieces.
std::uint32_t cutPlace(const SubGraph& part, int firstPieces, int pieces) {
  const std::uint32_t least = firstPieces, most = part.nodeCount() - (pieces - firstPieces);
  const double wanted = totalSize(part) * firstPieces / pieces;
  if (part.sizes.empty()) return std::clamp(static_cast<std::uint32_t>(std::ceil(wanted)), least, most);
  std::uint32_t place = 0;
  for (double sum = 0; place < most && sum + sizeOf(part, place) / 2 < wanted; ++place) sum += sizeOf(part, place);
  return std::clamp(place, least, most);
}

/// A part numbered from one end, cut in two connected sides.
struct Sides {
  std::uint32_t place;    ///< nodes below it are the first side's
  Sweep first;            ///< the first side, open
  Sweep second;           ///< the second side, numbered from the far end
  double secondSize = 0;  ///< of its nodes
  Sides(const SubGraph& part, std::uint32_t place_);
};

/// Numbers the largest island of the nodes from `place` on (of equals the one nearest to the end).
void sweepLargestIsland(const SubGraph& part, std::uint32_t place, Sweep& sweep) {
  const std::uint32_t end = part.nodeCount();
  sweep.openRange(place, end);
  std::uint32_t left = end - place, largest = 0, largestStart = 0;
  for (std::uint32_t start = end; start-- > place && left > largest;) {
    if (!sweep.isOpen(start)) continue;
    const std::uint32_t count = sweep.from(start, part);
    left -= count;
    if (count > largest) std::tie(largest, largestStart) = std::pair(count, start);
  }
  if (largest == end - place) return;
  sweep.reopen();
  sweep.from(largestStart, part);
}

/// The nodes from `place` on without all islands but their largest.
Sides::Sides(const SubGraph& part, std::uint32_t place_)
    : place(place_), first(part.nodeCount()), second(part.nodeCount()) {
  sweepLargestIsland(part, place, second);
  for (std::uint32_t node = place; node < part.nodeCount(); ++node)
    if (second.isOpen(node)) second.close(node);
  first.openRange(0, part.nodeCount());
  for (const std::uint32_t node : second.order()) {
    first.close(node);
    secondSize += sizeOf(part, node);
  }
}

/// Cut in proportion to pieces: where the second side loses islands, again with as much more for it, and the best of a
/// few such cuts.
Sides evenSides(const SubGraph& part, int firstPieces, int pieces) {
  constexpr int tries = 3;
  constexpr double closeEnough = 0.02;  // of a piece
  const double piece = totalSize(part) / pieces, wanted = piece * (pieces - firstPieces);
  const auto missing = [&](const Sides& sides) { return wanted - sides.secondSize; };
  const auto least = static_cast<std::uint32_t>(firstPieces);
  Sides best(part, cutPlace(part, firstPieces, pieces));
  std::uint32_t place = best.place;
  double lost = missing(best);
  for (int i = 0; i < tries && lost > closeEnough * piece && place > least; ++i) {
    for (double back = 0; place > least && back < lost; back += sizeOf(part, place)) --place;
    Sides other(part, place);
    lost = missing(other);
    if (std::abs(lost) < std::abs(missing(best))) best = std::move(other);
  }
  return best;
}

/// Divides parts and notes the piece of every node; a part's pieces have consecutive numbers.
class Divider {
 public:
  explicit Divider(std::vector<int>& pieceOf) : pieceOf_(pieceOf) {}

  void divide(const SubGraph& part, int firstPiece, int pieces) {
    if (pieces == 1) return assign(part, firstPiece);
    Sides sides = evenSides(part, (pieces + 1) / 2, pieces);
    const int ofFirst = piecesOfFirst(part, sides, pieces);
    const auto side = [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
        if (i == 0)
          divideFirst(part, sides, firstPiece, ofFirst);
        else
          divideSecond(part, sides, firstPiece + ofFirst, pieces - ofFirst);
    };
    parallelFor(0, 2, part.nodeCount() < leastTask ? 2 : 1, side);
  }

 private:
  static constexpr std::uint32_t leastTask = 4096;  ///< nodes that are worth a thread's while

  void assign(const SubGraph& part, int piece) {
    for (const std::uint32_t name : part.names) pieceOf_[name] = piece;
  }

  /// In proportion to what the sides really hold, and never more than they have nodes.
  static int piecesOfFirst(const SubGraph& part, const Sides& sides, int pieces) {
    const double total = totalSize(part);
    const auto share = static_cast<int>(std::lround(pieces * (total - sides.secondSize) / total));
    const auto nodesOfSecond = static_cast<int>(sides.second.count());
    const int nodesOfFirst = static_cast<int>(part.nodeCount()) - nodesOfSecond;
    return std::clamp(share, std::max(1, pieces - nodesOfSecond), std::min(pieces - 1, nodesOfFirst));
  }

  void divideFirst(const SubGraph& part, Sides& sides, int firstPiece, int pieces) {
    if (pieces > 1) return divide(orderedFromAnEnd(part, sides.first, sides.place - 1), firstPiece, pieces);
    for (std::uint32_t node = 0; node < part.nodeCount(); ++node)
      if (sides.first.isOpen(node)) pieceOf_[part.names[node]] = firstPiece;
  }

  void divideSecond(const SubGraph& part, Sides& sides, int firstPiece, int pieces) {
    for (const std::uint32_t node : sides.second.order()) pieceOf_[part.names[node]] = firstPiece;
    if (pieces == 1) return;
    const std::uint32_t end = sides.second.order().back();
    sides.second.reopen();
    sides.second.from(end, part);
    divide(sides.second.part(part), firstPiece, pieces);
  }

  std::vector<int>& pieceOf_;
};

SubGraph fromAnEnd(const SubGraph& part) {
  Sweep sweep(part.nodeCount());
  sweep.openRange(0, part.nodeCount());
  return orderedFromAnEnd(part, sweep, part.nodeCount() - 1);
}

}  // namespace

Partition partitionBreadthFirst(const FractureGraph& graph, int pieces) {
  CHECK(pieces >= 1, "pieces {}", pieces);
  checkPieceCount(graph, pieces);
  const std::vector<SubGraph> parts = componentsOf(graph);
  const std::vector<int> shares = sharePieces(parts, pieces);
  Partition partition{std::vector<int>(graph.nodeCount()), 0};
  Divider divider(partition.pieceOf);
  for (std::size_t i = 0; i < parts.size(); partition.count += shares[i++])
    divider.divide(fromAnEnd(parts[i]), partition.count, shares[i]);
  numberByLowestNode(partition);
  return partition;
}

std::vector<std::uint32_t> breadthFirstHalf(const SubGraph& part) {
  const SubGraph ordered = fromAnEnd(part);
  const Sides sides = evenSides(ordered, 1, 2);
  std::vector<std::uint32_t> half;
  for (const std::uint32_t node : sides.second.order()) half.push_back(ordered.names[node]);
  return half;
}

}  // namespace brisance
