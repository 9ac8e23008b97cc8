#include "fracture/piece_moves.h"

#include <array>

namespace brisance {
namespace {

/// Weights towards the pieces around a node; a node that touches more pieces than fit is offered the first ones.
struct Around {
  static constexpr int most = 24;
  std::array<std::uint32_t, most> piece;
  std::array<float, most> weight;
  int count = 0;
  void add(std::uint32_t p, float w) {
    int i = 0;
    while (i < count && piece[i] != p) ++i;
    if (i < count) {
      weight[i] += w;
    } else if (count < most) {
      piece[count] = p;
      weight[count++] = w;
    }
  }
};

}  // namespace

PieceMoves::PieceMoves(const CoarseLevel& level, Numbers pieceOf, const SizeLimits& limits)
    : level_(level),
      pieceOf_(std::move(pieceOf)),
      limits_(limits),
      sizeOf_(limits.most.size(), 0),
      nodesOf_(limits.most.size(), 0),
      seenBy_(level.nodeCount(), 0) {
  for (std::uint32_t node = 0; node < level.nodeCount(); ++node) {
    sizeOf_[pieceOf_[node]] += level.sizes[node];
    ++nodesOf_[pieceOf_[node]];
  }
}

bool PieceMoves::onBorder(std::uint32_t node) const {
  for (const std::uint32_t next : neighbours(node))
    if (pieceOf_[next] != pieceOf_[node]) return true;
  return false;
}

bool PieceMoves::allowed(std::uint32_t node, std::uint32_t to) const {
  const std::uint32_t from = pieceOf_[node];
  const double size = level_.sizes[node];
  if (nodesOf_[from] == 1 || sizeOf_[from] - size < limits_.least[from]) return false;
  if (sizeOf_[to] + size <= limits_.most[to]) return true;
  return excess(from) > 0 && fullness(to, size) < fullness(from, 0);
}

PieceMoves::Move PieceMoves::best(std::uint32_t node) const {
  const std::uint32_t own = pieceOf_[node];
  Around around;
  float stay = 0;
  for (std::uint32_t e = level_.first[node]; e < level_.first[node + 1]; ++e) {
    const std::uint32_t piece = pieceOf_[level_.targets[e]];
    if (piece == own)
      stay += level_.weights[e];
    else
      around.add(piece, level_.weights[e]);
  }
  Move move{node, own, 0};
  for (int i = 0; i < around.count; ++i) {
    const std::uint32_t to = around.piece[i];
    const float gain = around.weight[i] - stay;
    if (move.to != own && gain < move.gain) continue;
    if (move.to != own && gain == move.gain && fullness(to, 0) >= fullness(move.to, 0)) continue;
    if (allowed(node, to)) move = {node, to, gain};
  }
  return move;
}

bool PieceMoves::evensOut(const Move& move) const {
  return fullness(move.to, level_.sizes[move.node]) < fullness(pieceOf_[move.node], 0);
}

bool PieceMoves::leavesConnected(std::uint32_t node) {
  constexpr std::size_t farthest = 64;  // nodes looked at: the way around a corner where a dozen triangles meet
  const std::uint32_t own = pieceOf_[node];
  const std::uint32_t wanted = ++search_, seen = ++search_;
  std::size_t missing = 0;
  found_.clear();
  for (const std::uint32_t next : neighbours(node)) {
    if (pieceOf_[next] != own) continue;
    if (found_.empty()) {
      found_.push_back(next);
      seenBy_[next] = seen;
    } else {
      seenBy_[next] = wanted;
      ++missing;
    }
  }
  seenBy_[node] = seen;
  for (std::size_t i = 0; i < found_.size() && missing > 0 && i < farthest; ++i)
    for (const std::uint32_t next : neighbours(found_[i])) {
      if (pieceOf_[next] != own || seenBy_[next] == seen) continue;
      missing -= seenBy_[next] == wanted;
      seenBy_[next] = seen;
      found_.push_back(next);
    }
  return missing == 0;
}

void PieceMoves::make(std::uint32_t node, std::uint32_t to) {
  const std::uint32_t from = pieceOf_[node];
  sizeOf_[from] -= level_.sizes[node];
  sizeOf_[to] += level_.sizes[node];
  --nodesOf_[from];
  ++nodesOf_[to];
  pieceOf_[node] = to;
}

}  // namespace brisance
