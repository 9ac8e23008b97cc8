#include "fracture/graph_multigrid.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "base/check.h"
#include "fracture/block_vector.h"

namespace brisance {
namespace {

using Numbers = AlignedVector<std::uint32_t>;

constexpr std::uint32_t noNode = 0xFFFFFFFFu;

/// At most 16 blocks, so that few edges lie between them, and none too small to be worth a thread.
std::uint32_t rowsPerBlock(std::uint32_t rows) {
  constexpr std::uint32_t mostBlocks = 16, leastRows = 4096;
  const std::uint32_t blocks = std::clamp(rows / leastRows, 1u, mostBlocks);
  return (rows + blocks - 1) / blocks;
}

/// body(block, first row, last row), each block on one thread.
template <class Body>
void forBlocks(std::uint32_t rows, const Body& body) {
  const std::uint32_t blockRows = rowsPerBlock(rows), blocks = (rows + blockRows - 1) / blockRows;
  parallelFor(0, blocks, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto b = static_cast<std::uint32_t>(begin); b < end; ++b)
      body(b, b * blockRows, std::min(rows, (b + 1) * blockRows));
  });
}

/// In single precision and of weights about 1, whatever their unit.
LaplacianRows finestRows(const FractureGraph& graph) {
  LaplacianRows rows;
  rows.first.assign(graph.first.begin(), graph.first.end());
  rows.targets.resize(graph.targets.size());
  rows.weights.resize(graph.targets.size());
  rows.diagonal.resize(static_cast<std::size_t>(graph.nodeCount()));
  const double scale = graph.weights.empty() ? 1 : 1 / *std::max_element(graph.weights.begin(), graph.weights.end());
  forNodes(rows.diagonal.size(), [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      float diagonal = 0;
      for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
        rows.targets[k] = graph.targets[k];
        rows.weights[k] = graph.weights.empty() ? 1.f : static_cast<float>(graph.weights[k] * scale);
        diagonal += rows.weights[k];
      }
      rows.diagonal[i] = diagonal;
    }
  });
  return rows;
}

/// Leader of each node's aggregate, pairing inside blocks of rows.
class Pairing {
 public:
  explicit Pairing(const LaplacianRows& rows) : rows_(rows), leader_(rows.size(), noNode) {
    forBlocks(rows.size(), [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) { pairBlock(begin, end); });
    for (std::uint32_t i = 0; i < rows.size(); ++i)
      if (leader_[i] == noNode) join(i);
  }
  /// Number of each node's aggregate, in the order of their leaders.
  Numbers aggregates(std::uint32_t& count) const {
    Numbers number(leader_.size());
    count = 0;
    for (std::uint32_t i = 0; i < leader_.size(); ++i)
      if (leader_[i] == i) number[i] = count++;
    Numbers result(leader_.size());
    forNodes(leader_.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) result[i] = number[leader_[i]];
    });
    return result;
  }

 private:
  void pairBlock(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      if (leader_[i] != noNode) continue;
      std::uint32_t partner = noNode, leader = noNode;
      float strongest = 0, strongestPaired = 0;
      for (std::uint32_t k = rows_.first[i]; k < rows_.first[i + 1]; ++k) {
        const std::uint32_t j = rows_.targets[k];
        if (j < begin || j >= end) continue;
        const float weight = rows_.weights[k];
        if (leader_[j] != noNode) {
          if (weight > strongestPaired) strongestPaired = weight, leader = leader_[j];
        } else if (const float strength = weight / std::sqrt(rows_.diagonal[j]); strength > strongest) {
          strongest = strength, partner = j;
        }
      }
      if (partner != noNode)
        leader_[i] = leader_[partner] = i;
      else
        leader_[i] = leader;
    }
  }

  /// A node without neighbours in its block goes to its strongest one elsewhere.
  void join(std::uint32_t i) {
    std::uint32_t strongest = i;
    float weight = 0;
    for (std::uint32_t k = rows_.first[i]; k < rows_.first[i + 1]; ++k)
      if (rows_.weights[k] > weight) weight = rows_.weights[k], strongest = rows_.targets[k];
    if (leader_[strongest] == noNode) leader_[strongest] = strongest;
    leader_[i] = leader_[strongest];
  }

  const LaplacianRows& rows_;
  Numbers leader_;
};

struct Members {
  Numbers first, nodes;
};

Members membersOf(const Numbers& aggregateOf, std::uint32_t count) {
  Members members{Numbers(count + 1, 0), Numbers(aggregateOf.size())};
  for (const std::uint32_t a : aggregateOf) ++members.first[a + 1];
  std::partial_sum(members.first.begin(), members.first.end(), members.first.begin());
  Numbers next(members.first.begin(), members.first.end() - 1);
  for (std::uint32_t i = 0; i < aggregateOf.size(); ++i) members.nodes[next[aggregateOf[i]]++] = i;
  return members;
}

/// Rows of some aggregates: edges between their nodes added up.
struct RowsOfBlock {
  Numbers lengths, targets;
  AlignedVector<float> weights, diagonal;
};

RowsOfBlock coarseBlock(const LaplacianRows& fine, const Numbers& aggregateOf, const Members& members,
                        std::uint32_t begin, std::uint32_t end) {
  RowsOfBlock block;
  Numbers placeOf(members.first.size() - 1,
                  0);  // 1 + place of a target in the block, if in this row
  for (std::uint32_t a = begin; a < end; ++a) {
    const std::size_t rowBegin = block.targets.size();
    double diagonal = 0;
    for (std::uint32_t m = members.first[a]; m < members.first[a + 1]; ++m)
      for (std::uint32_t k = fine.first[members.nodes[m]]; k < fine.first[members.nodes[m] + 1]; ++k) {
        const std::uint32_t target = aggregateOf[fine.targets[k]];
        if (target == a) continue;
        diagonal += fine.weights[k];
        if (placeOf[target] > rowBegin) {
          block.weights[placeOf[target] - 1] += fine.weights[k];
        } else {
          block.targets.push_back(target);
          block.weights.push_back(fine.weights[k]);
          placeOf[target] = static_cast<std::uint32_t>(block.targets.size());
        }
      }
    block.lengths.push_back(static_cast<std::uint32_t>(block.targets.size() - rowBegin));
    block.diagonal.push_back(static_cast<float>(diagonal));
  }
  return block;
}

LaplacianRows coarseRows(const LaplacianRows& fine, const Numbers& aggregateOf, const Members& members) {
  const auto count = static_cast<std::uint32_t>(members.first.size() - 1);
  const std::uint32_t blockRows = rowsPerBlock(count);
  std::vector<RowsOfBlock> blocks((count + blockRows - 1) / blockRows);
  forBlocks(count, [&](std::uint32_t b, std::uint32_t begin, std::uint32_t end) {
    blocks[b] = coarseBlock(fine, aggregateOf, members, begin, end);
  });
  LaplacianRows rows;
  rows.first.reserve(count + 1);
  rows.first.push_back(0);
  for (const RowsOfBlock& block : blocks)
    for (const std::uint32_t length : block.lengths) rows.first.push_back(rows.first.back() + length);
  rows.targets.resize(rows.first.back());
  rows.weights.resize(rows.first.back());
  rows.diagonal.resize(count);
  forBlocks(count, [&](std::uint32_t b, std::uint32_t begin, std::uint32_t) {
    std::copy(blocks[b].targets.begin(), blocks[b].targets.end(), rows.targets.begin() + rows.first[begin]);
    std::copy(blocks[b].weights.begin(), blocks[b].weights.end(), rows.weights.begin() + rows.first[begin]);
    std::copy(blocks[b].diagonal.begin(), blocks[b].diagonal.end(), rows.diagonal.begin() + begin);
  });
  return rows;
}

/// Puts the entries of each row in the order that smoothing wants.
void orderEntries(GraphLevel& level) {
  LaplacianRows& rows = level.rows;
  level.blockRows = rowsPerBlock(rows.size());
  level.belowEnd.resize(rows.size());
  level.insideEnd.resize(rows.size());
  forBlocks(rows.size(), [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
    const auto kind = [&](std::uint32_t i, std::uint32_t j) { return j < begin || j >= end ? 2 : j < i ? 0 : 1; };
    std::vector<std::pair<std::uint32_t, float>> row;
    for (std::uint32_t i = begin; i < end; ++i) {
      row.clear();
      for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
        row.emplace_back(rows.targets[k], rows.weights[k]);
      std::uint32_t k = rows.first[i];
      for (int wanted = 0; wanted < 3; ++wanted) {
        for (const auto& [target, weight] : row)
          if (kind(i, target) == wanted) rows.targets[k] = target, rows.weights[k++] = weight;
        if (wanted == 0) level.belowEnd[i] = k;
        if (wanted == 1) level.insideEnd[i] = k;
      }
    }
  });
}

/// Fills in how the level goes over into the next, and returns that.
GraphLevel coarsen(GraphLevel& level) {
  std::uint32_t pairs = 0, count = 0;
  const Numbers pairOf = Pairing(level.rows).aggregates(pairs);
  const LaplacianRows pairRows = coarseRows(level.rows, pairOf, membersOf(pairOf, pairs));
  const Numbers fourOf = Pairing(pairRows).aggregates(count);
  GraphLevel coarse;
  coarse.rows = coarseRows(pairRows, fourOf, membersOf(fourOf, count));
  level.aggregateOf.resize(pairOf.size());
  forNodes(pairOf.size(), [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) level.aggregateOf[i] = fourOf[pairOf[i]];
  });
  Members members = membersOf(level.aggregateOf, count);
  level.memberFirst = std::move(members.first);
  level.members = std::move(members.nodes);
  coarse.mass.resize(count);
  forNodes(count, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t a = begin; a < end; ++a)
      for (std::uint32_t m = level.memberFirst[a]; m < level.memberFirst[a + 1]; ++m)
        coarse.mass[a] += level.mass[level.members[m]];
  });
  return coarse;
}

/// (L + c 1 1^T)^-1 - 1 1^T / (c n^2), with c of the size of L's entries, is the pseudo-inverse of L.
std::vector<float> pseudoInverse(const LaplacianRows& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      matrix(i, rows.targets[k]) -= rows.weights[k];
      matrix(i, i) += rows.weights[k];
    }
  const double trace = matrix.trace();
  const double shift = trace > 0 ? trace / static_cast<double>(n * n) : 1;
  matrix.array() += shift;
  Eigen::MatrixXd inverse = matrix.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  inverse.array() -= 1 / (shift * static_cast<double>(n * n));
  std::vector<float> result(static_cast<std::size_t>(n * n));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      result[static_cast<std::size_t>(i * n + j)] = static_cast<float>(inverse(i, j));
  return result;
}

}  // namespace

GraphMultigrid::GraphMultigrid(const FractureGraph& graph) {
  levels.emplace_back();
  levels[0].rows = finestRows(graph);
  levels[0].mass.assign(levels[0].rows.size(), 1.f);
  while (levels.back().rows.size() > coarsestSize) {
    GraphLevel coarse = coarsen(levels.back());
    CHECK(2 * coarse.rows.size() <= levels.back().rows.size(), "{} nodes of {}: the graph is not connected",
          coarse.rows.size(), levels.back().rows.size());
    orderEntries(levels.back());
    levels.push_back(std::move(coarse));
  }
  coarsestInverse = pseudoInverse(levels.back().rows);
}

}  // namespace brisance
