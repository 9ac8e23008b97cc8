#include "fracture/refine_cut.h"

#include <algorithm>
#include <deque>
#include <queue>

#include "base/check.h"
#include "fracture/piece_moves.h"

namespace brisance {
namespace {

constexpr double slack = 0.06;               ///< pieces may be larger than wanted by this share of it
constexpr double leastShare = 0.8;           ///< and not smaller than this one
constexpr double coarsestNodes = 24;         ///< of a piece of the mean size
constexpr float leastGain = 1e-5f;           ///< of mean weights: below it is rounding
constexpr std::uint32_t fewNodes = 100'000;  ///< levels up to this size are searched for moves that pay off later

/// Moves from the border while they shorten the cut, or keep it and even out sizes.
void moveDownhill(PieceMoves& moves) {
  std::deque<std::uint32_t> queue;
  std::vector<bool> queued(moves.nodeCount(), false);
  for (std::uint32_t node = 0; node < moves.nodeCount(); ++node)
    if (moves.onBorder(node)) {
      queue.push_back(node);
      queued[node] = true;
    }
  while (!queue.empty()) {
    const std::uint32_t node = queue.front();
    queue.pop_front();
    queued[node] = false;
    const PieceMoves::Move move = moves.best(node);
    if (move.to == moves.piece(node) || move.gain < -leastGain) continue;
    if (move.gain <= leastGain && !moves.evensOut(move)) continue;
    if (!moves.leavesConnected(node)) continue;
    moves.make(node, move.to);
    for (const std::uint32_t next : moves.neighbours(node)) {
      if (queued[next]) continue;
      queue.push_back(next);
      queued[next] = true;
    }
  }
}

struct ByGain {
  bool operator()(const PieceMoves::Move& a, const PieceMoves::Move& b) const {
    return a.gain != b.gain ? a.gain < b.gain : a.node > b.node;
  }
};
using MoveQueue = std::priority_queue<PieceMoves::Move, std::vector<PieceMoves::Move>, ByGain>;

/// The best move of the queue that is still what it was when it entered; false if none is left.
bool nextMove(MoveQueue& queue, PieceMoves& moves, PieceMoves::Move& move) {
  while (!queue.empty()) {
    move = queue.top();
    queue.pop();
    const PieceMoves::Move now = moves.best(move.node);
    if (now.to == moves.piece(move.node)) continue;
    if (now.to == move.to && now.gain == move.gain) {
      if (moves.leavesConnected(move.node)) return true;
      continue;
    }
    queue.push(now);
  }
  return false;
}

/// Pieces above their limit give nodes of their border to neighbours that are less full, at the least cost.
void evenOut(PieceMoves& moves) {
  constexpr int rounds = 8;  // a surplus passes on from neighbour to neighbour
  for (int round = 0; round < rounds; ++round) {
    MoveQueue queue;
    for (std::uint32_t node = 0; node < moves.nodeCount(); ++node)
      if (moves.excess(moves.piece(node)) > 0 && moves.onBorder(node)) queue.push(moves.best(node));
    if (queue.empty()) return;
    PieceMoves::Move move;
    while (nextMove(queue, moves, move)) {
      const std::uint32_t from = moves.piece(move.node);
      if (moves.excess(from) <= 0) continue;
      moves.make(move.node, move.to);
      for (const std::uint32_t next : moves.neighbours(move.node))
        if (moves.piece(next) == from) queue.push(moves.best(next));
    }
  }
}

/// Searches around single nodes of the border for runs of moves that pay off together though the first ones cost
/// (localised k-way search: Sanders & Schulz 2011).
class LocalSearch {
 public:
  explicit LocalSearch(PieceMoves& moves) : moves_(moves), movedIn_(moves.nodeCount(), 0) {}

  void pass() {
    ++pass_;
    for (std::uint32_t node = 0; node < moves_.nodeCount(); ++node)
      if (movedIn_[node] != pass_ && moves_.onBorder(node)) from(node);
  }

 private:
  static constexpr int patience = 15;  ///< moves that do not pay off before the search gives up

  void from(std::uint32_t start) {
    MoveQueue queue;
    std::vector<PieceMoves::Move> back;  // what undoes each move
    std::size_t kept = 0;
    float gain = 0, bestGain = leastGain;
    queue.push(moves_.best(start));
    PieceMoves::Move move;
    while (back.size() < kept + patience && nextMove(queue, moves_, move)) {
      back.push_back({move.node, moves_.piece(move.node), 0});
      moves_.make(move.node, move.to);
      movedIn_[move.node] = pass_;
      gain += move.gain;
      if (gain > bestGain) {
        bestGain = gain + leastGain;
        kept = back.size();
      }
      for (const std::uint32_t next : moves_.neighbours(move.node))
        if (movedIn_[next] != pass_ && moves_.onBorder(next)) queue.push(moves_.best(next));
    }
    for (; back.size() > kept; back.pop_back()) moves_.make(back.back().node, back.back().to);
  }

  PieceMoves& moves_;
  std::vector<std::uint32_t> movedIn_;
  std::uint32_t pass_ = 0;
};

Numbers refined(const CoarseLevel& level, Numbers pieceOf, const SizeLimits& limits) {
  PieceMoves moves(level, std::move(pieceOf), limits);
  evenOut(moves);
  moveDownhill(moves);
  if (level.nodeCount() <= fewNodes) {
    constexpr int passes = 2;
    LocalSearch search(moves);
    for (int pass = 0; pass < passes; ++pass) {
      search.pass();
      moveDownhill(moves);
    }
  }
  return moves.pieces();
}

SizeLimits limitsOf(const CoarseLevel& finest, Balance balance) {
  const std::size_t pieces = finest.pieceBegin.size() - 1;
  std::vector<double> wanted(pieces, 0);
  double total = 0;
  for (std::size_t piece = 0; piece < pieces; ++piece)
    for (std::uint32_t node = finest.pieceBegin[piece]; node < finest.pieceBegin[piece + 1]; ++node) {
      wanted[piece] += finest.sizes[node];
      total += finest.sizes[node];
    }
  if (balance == Balance::even) wanted.assign(pieces, total / static_cast<double>(pieces));
  SizeLimits limits;
  for (const double size : wanted) {
    limits.least.push_back(leastShare * size);
    // Small pieces must be able to take one more node.
    limits.most.push_back(std::max((1 + slack) * size, size + 1));
  }
  return limits;
}

/// Levels from the given graph down to a few nodes for each piece.
std::vector<CoarseLevel> levelsOf(CoarseLevel finest, int pieces) {
  constexpr double leastStep = 0.95;  // a level that hardly shrinks is not worth its memory
  const double coarsest = coarsestNodes * pieces, largestNode = finest.nodeCount() / coarsest;
  std::vector<CoarseLevel> levels;
  levels.push_back(std::move(finest));
  while (levels.back().nodeCount() > coarsest) {
    CoarseLevel next = coarser(levels.back(), largestNode);
    if (next.nodeCount() > leastStep * levels.back().nodeCount()) break;
    levels.push_back(std::move(next));
  }
  return levels;
}

Numbers piecesWhereMade(const CoarseLevel& level) {
  Numbers pieceOf(level.nodeCount());
  for (std::uint32_t piece = 0; piece + 1 < level.pieceBegin.size(); ++piece)
    std::fill(pieceOf.begin() + level.pieceBegin[piece], pieceOf.begin() + level.pieceBegin[piece + 1], piece);
  return pieceOf;
}

Numbers onFiner(const CoarseLevel& finer, const Numbers& pieceOf) {
  Numbers result(finer.nodeCount());
  for (std::uint32_t node = 0; node < finer.nodeCount(); ++node) result[node] = pieceOf[finer.coarse[node]];
  return result;
}

}  // namespace

Partition refineCut(const FractureGraph& graph, const Partition& partition, Balance balance) {
  CHECK(static_cast<int>(partition.pieceOf.size()) == graph.nodeCount(), "{} nodes of {}", partition.pieceOf.size(),
        graph.nodeCount());
  if (partition.count < 2) return partition;
  Numbers names;
  std::vector<CoarseLevel> levels = levelsOf(finestLevel(graph, partition, names), partition.count);
  const SizeLimits limits = limitsOf(levels[0], balance);
  Numbers pieceOf = refined(levels.back(), piecesWhereMade(levels.back()), limits);
  for (levels.pop_back(); !levels.empty(); levels.pop_back())
    pieceOf = refined(levels.back(), onFiner(levels.back(), pieceOf), limits);
  Partition result{std::vector<int>(graph.nodeCount()), partition.count};
  for (std::uint32_t node = 0; node < pieceOf.size(); ++node)
    result.pieceOf[names[node]] = static_cast<int>(pieceOf[node]);
  numberByLowestNode(result);
  return result;
}

}  // namespace brisance
