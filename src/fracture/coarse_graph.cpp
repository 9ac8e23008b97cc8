#include "fracture/coarse_graph.h"

#include <functional>
#include <numeric>
#include <tuple>

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr std::int64_t nodesPerTask = 32768;

/// Calls body(first piece, one past the last) on groups of pieces with about the same number of nodes.
void forPieces(const CoarseLevel& level, const std::function<void(std::uint32_t, std::uint32_t)>& body) {
  const std::vector<std::uint32_t>& begin = level.pieceBegin;
  std::vector<std::uint32_t> groups{0};
  for (std::uint32_t piece = 1; piece < begin.size(); ++piece)
    if (begin[piece] - begin[groups.back()] >= nodesPerTask || piece + 1 == begin.size()) groups.push_back(piece);
  parallelFor(0, static_cast<std::int64_t>(groups.size()) - 1, 1, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t group = from; group < to; ++group) body(groups[group], groups[group + 1]);
  });
}

double meanWeight(const FractureGraph& graph) {
  if (graph.weights.empty()) return 1;
  return std::accumulate(graph.weights.begin(), graph.weights.end(), 0.0) / static_cast<double>(graph.weights.size());
}

double meanSize(const FractureGraph& graph) {
  if (graph.sizes.empty()) return 1;
  return std::accumulate(graph.sizes.begin(), graph.sizes.end(), 0.0) / graph.nodeCount();
}

/// Nodes by piece, each piece's in their old order; new number of each old node in `numbers`.
void sortByPiece(const Partition& partition, CoarseLevel& level, Numbers& names, Numbers& numbers) {
  const auto nodes = static_cast<std::uint32_t>(partition.pieceOf.size());
  level.pieceBegin.assign(partition.count + 1, 0);
  for (const int piece : partition.pieceOf) ++level.pieceBegin[piece + 1];
  std::partial_sum(level.pieceBegin.begin(), level.pieceBegin.end(), level.pieceBegin.begin());
  std::vector<std::uint32_t> next(level.pieceBegin.begin(), level.pieceBegin.end() - 1);
  names.resize(nodes);
  numbers.resize(nodes);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    numbers[node] = next[partition.pieceOf[node]]++;
    names[numbers[node]] = node;
  }
}

/// Each node's partner, or itself.
Numbers pairs(const CoarseLevel& level, double largestSize) {
  constexpr std::uint32_t none = 0xFFFFFFFFu;
  Numbers mate(level.nodeCount());
  const auto pairPiece = [&](std::uint32_t begin, std::uint32_t end) {
    std::fill(mate.begin() + begin, mate.begin() + end, none);
    for (std::uint32_t node = begin; node < end; ++node) {
      if (mate[node] != none) continue;
      std::uint32_t best = node;
      float bestRating = 0;
      for (std::uint32_t e = level.first[node]; e < level.first[node + 1]; ++e) {
        const std::uint32_t other = level.targets[e];
        if (other < begin || other >= end || mate[other] != none) continue;
        if (level.sizes[node] + level.sizes[other] > largestSize) continue;
        const float rating = level.weights[e] * level.weights[e] / (level.sizes[node] * level.sizes[other]);
        if (rating > bestRating) std::tie(best, bestRating) = std::pair(other, rating);
      }
      mate[node] = best;
      mate[best] = node;
    }
  };
  forPieces(level, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t piece = first; piece < last; ++piece)
      pairPiece(level.pieceBegin[piece], level.pieceBegin[piece + 1]);
  });
  return mate;
}

/// Numbers pairs by piece and lowest node.
void numberPairs(const Numbers& mate, CoarseLevel& finer, CoarseLevel& result) {
  finer.coarse.resize(finer.nodeCount());
  result.pieceBegin.assign(finer.pieceBegin.size(), 0);
  std::uint32_t next = 0;
  for (std::size_t piece = 0; piece + 1 < finer.pieceBegin.size(); ++piece) {
    result.pieceBegin[piece] = next;
    for (std::uint32_t node = finer.pieceBegin[piece]; node < finer.pieceBegin[piece + 1]; ++node)
      finer.coarse[node] = mate[node] >= node ? next++ : finer.coarse[mate[node]];
  }
  result.pieceBegin.back() = next;
  result.sizes.resize(next);
  result.first.resize(next + 1u);
}

/// The rows of some consecutive coarse nodes.
struct Rows {
  Numbers targets;
  Amounts weights;
};

/// Edges of pairs [begin node, end node) to other pairs, those between the same two pairs added up. Leaves each row's
/// length in `result.first`, one place behind its node.
Rows joinedRows(const CoarseLevel& finer, const Numbers& mate, std::uint32_t begin, std::uint32_t end,
                CoarseLevel& result) {
  Rows rows;
  rows.targets.resize(finer.first[end] - finer.first[begin] + 1);
  rows.weights.resize(rows.targets.size());
  std::vector<std::uint32_t> placeOf(result.nodeCount(), 0);
  std::uint32_t used = 0;
  for (std::uint32_t node = begin; node < end; ++node) {
    if (mate[node] < node) continue;
    const std::uint32_t coarse = finer.coarse[node], rowBegin = used;
    for (const std::uint32_t member : {node, mate[node]}) {
      for (std::uint32_t e = finer.first[member]; e < finer.first[member + 1]; ++e) {
        const std::uint32_t target = finer.coarse[finer.targets[e]];
        if (target == coarse) continue;
        const std::uint32_t place = placeOf[target];
        if (place >= rowBegin && place < used && rows.targets[place] == target) {
          rows.weights[place] += finer.weights[e];
        } else {
          placeOf[target] = used;
          rows.targets[used] = target;
          rows.weights[used++] = finer.weights[e];
        }
      }
      if (mate[node] == node) break;
    }
    result.sizes[coarse] = finer.sizes[node] + (mate[node] == node ? 0 : finer.sizes[mate[node]]);
    result.first[coarse + 1] = used - rowBegin;
  }
  rows.targets.resize(used);
  rows.weights.resize(used);
  return rows;
}

}  // namespace

CoarseLevel finestLevel(const FractureGraph& graph, const Partition& partition, Numbers& names) {
  CoarseLevel level;
  Numbers numbers;
  sortByPiece(partition, level, names, numbers);
  const std::uint32_t nodes = static_cast<std::uint32_t>(graph.nodeCount());
  level.first.resize(nodes + 1u);
  level.first[0] = 0;
  for (std::uint32_t node = 0; node < nodes; ++node)
    level.first[node + 1] = level.first[node] + graph.first[names[node] + 1] - graph.first[names[node]];
  level.targets.resize(graph.targets.size());
  level.weights.resize(graph.targets.size());
  level.sizes.resize(nodes);
  const double weight = meanWeight(graph), size = meanSize(graph);
  parallelFor(0, nodes, nodesPerTask, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t node = begin; node < end; ++node) {
      const std::uint32_t name = names[node];
      level.sizes[node] = graph.sizes.empty() ? 1.0f : static_cast<float>(graph.sizes[name] / size);
      for (std::uint32_t e = graph.first[name], to = level.first[node]; e < graph.first[name + 1]; ++e, ++to) {
        level.targets[to] = numbers[graph.targets[e]];
        level.weights[to] = graph.weights.empty() ? 1.0f : static_cast<float>(graph.weights[e] / weight);
      }
    }
  });
  return level;
}

CoarseLevel coarser(CoarseLevel& finer, double largestSize) {
  const Numbers mate = pairs(finer, largestSize);
  CoarseLevel result;
  numberPairs(mate, finer, result);
  // Each group of pieces makes its own rows, which are then put one behind the other.
  const std::size_t pieces = finer.pieceBegin.size() - 1;
  std::vector<Rows> rowsFrom(pieces);
  forPieces(finer, [&](std::uint32_t first, std::uint32_t last) {
    rowsFrom[first] = joinedRows(finer, mate, finer.pieceBegin[first], finer.pieceBegin[last], result);
  });
  result.first[0] = 0;
  for (std::uint32_t node = 0; node < result.nodeCount(); ++node) result.first[node + 1] += result.first[node];
  result.targets.resize(result.first.back());
  result.weights.resize(result.first.back());
  parallelFor(0, static_cast<std::int64_t>(pieces), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t piece = begin; piece < end; ++piece) {
      const std::uint32_t place = result.first[result.pieceBegin[piece]];
      std::copy(rowsFrom[piece].targets.begin(), rowsFrom[piece].targets.end(), result.targets.begin() + place);
      std::copy(rowsFrom[piece].weights.begin(), rowsFrom[piece].weights.end(), result.weights.begin() + place);
    }
  });
  return result;
}

}  // namespace brisance
