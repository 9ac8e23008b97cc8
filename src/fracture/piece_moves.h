// Single nodes of a partitioned graph move from piece to piece.
#pragma once

#include "fracture/coarse_graph.h"

namespace brisance {

/// Per piece, relative to the mean size of the finest nodes.
struct SizeLimits {
  std::vector<double> least, most;
};

/// Who is where on one level of the graph, and what a move would bring.
class PieceMoves {
 public:
  struct Move {
    std::uint32_t node, to;
    float gain;  ///< cut weight that it saves
  };

  PieceMoves(const CoarseLevel& level, Numbers pieceOf, const SizeLimits& limits);

  const Numbers& pieces() const { return pieceOf_; }
  std::uint32_t nodeCount() const { return level_.nodeCount(); }
  std::uint32_t piece(std::uint32_t node) const { return pieceOf_[node]; }
  double excess(std::uint32_t piece) const { return sizeOf_[piece] - limits_.most[piece]; }
  bool onBorder(std::uint32_t node) const;
  /// The move that saves most among those that the sizes allow; `to` is the node's own piece if there is none.
  Move best(std::uint32_t node) const;
  /// Whether the target is left smaller than the source was: such moves cannot go round in circles.
  bool evensOut(const Move& move) const;
  /// Whether the node's piece is still connected without it, as far as a short search around it tells.
  bool leavesConnected(std::uint32_t node);
  void make(std::uint32_t node, std::uint32_t to);
  std::span<const std::uint32_t> neighbours(std::uint32_t node) const {
    return {level_.targets.data() + level_.first[node], level_.first[node + 1] - level_.first[node]};
  }

 private:
  bool allowed(std::uint32_t node, std::uint32_t to) const;
  double fullness(std::uint32_t piece, double extra) const { return (sizeOf_[piece] + extra) / limits_.most[piece]; }

  const CoarseLevel& level_;
  Numbers pieceOf_;
  const SizeLimits& limits_;
  std::vector<double> sizeOf_;
  std::vector<int> nodesOf_;
  std::vector<std::uint32_t> seenBy_;  ///< the search that saw the node last
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> found_;
};

}  // namespace brisance
