// One multigrid cycle: an approximate solution of L x = b for several right sides at once.
#pragma once

#include <cmath>
#include <numeric>

#include "fracture/block_vector.h"
#include "fracture/graph_multigrid.h"

namespace brisance {

/// The K-cycle (Notay & Vassilevski 2008): on every level one Gauss-Seidel sweep down the rows, a correction from the
/// next level by one or two steps of flexible conjugate gradients, one sweep up. The cycle is symmetric up to those
/// steps; it is the same for any number of threads, since sweeps see across the borders of fixed blocks only what was
/// there before the sweep.
template <int K>
class MultigridCycle {
 public:
  using Vectors = BlockVector<K, float>;
  using Row = std::array<float, K>;

  explicit MultigridCycle(const GraphMultigrid& grid) : grid_(grid), scratch_(grid.levels.size()) {
    for (std::size_t l = 0; l < grid.levels.size(); ++l) {
      const std::uint32_t n = grid.levels[l].rows.size();
      scratch_[l].before.resize(n);
      if (l == 0) continue;
      Scratch& s = scratch_[l];
      for (Vectors* v : {&s.b, &s.x, &s.step, &s.image, &s.second}) v->resize(n);
    }
  }

  /// x ~ L^-1 b on a level, up to a constant; every column of b sums to 0.
  void apply(std::size_t level, const Vectors& b, Vectors& x) {
    if (level + 1 == grid_.levels.size()) return solveCoarsest(b, x);
    sweepDown(grid_.levels[level], b, x);
    restrictResidual(grid_.levels[level], x, scratch_[level + 1].b);
    correct(level + 1);
    prolong(grid_.levels[level], scratch_[level + 1].x, x, scratch_[level].before);
    sweepUp(grid_.levels[level], b, x, scratch_[level].before);
  }

 private:
  struct Scratch {
    Vectors b, x;         ///< problem and solution handed over from the finer level
    Vectors step, image;  ///< a cycle's result and L times it
    Vectors second;       ///< the result of another cycle
    Vectors before;       ///< what a sweep sees of other blocks
  };

  void solveCoarsest(const Vectors& b, Vectors& x) const {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
      Row sum{};
      for (std::size_t j = 0; j < n; ++j)
        for (int c = 0; c < K; ++c) sum[c] += grid_.coarsestInverse[i * n + j] * b[j][c];
      x[i] = sum;
    }
  }

  template <class Body>
  static void forBlocks(const GraphLevel& level, const Body& body) {
    const std::uint32_t rows = level.rows.size(), blocks = (rows + level.blockRows - 1) / level.blockRows;
    parallelFor(0, blocks, 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto block = static_cast<std::uint32_t>(begin); block < end; ++block)
        body(block * level.blockRows, std::min(rows, (block + 1) * level.blockRows));
    });
  }

  static void addEntries(const LaplacianRows& rows, std::uint32_t begin, std::uint32_t end, const Vectors& x,
                         Row& sum) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const Row& target = x[rows.targets[k]];
      for (int c = 0; c < K; ++c) sum[c] += rows.weights[k] * target[c];
    }
  }

  /// From x = 0, so only entries below the row count.
  static void sweepDown(const GraphLevel& level, const Vectors& b, Vectors& x) {
    forBlocks(level, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        Row sum = b[i];
        addEntries(level.rows, level.rows.first[i], level.belowEnd[i], x, sum);
        for (int c = 0; c < K; ++c) x[i][c] = sum[c] / level.rows.diagonal[i];
      }
    });
  }

  /// After sweepDown the residual b - L x is what its sweep did not see: the entries above and outside.
  static void restrictResidual(const GraphLevel& level, const Vectors& x, Vectors& coarse) {
    forNodes(coarse.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t a = begin; a < end; ++a) {
        Row sum{};
        for (std::uint32_t m = level.memberFirst[a]; m < level.memberFirst[a + 1]; ++m) {
          const std::uint32_t i = level.members[m];
          addEntries(level.rows, level.belowEnd[i], level.rows.first[i + 1], x, sum);
        }
        coarse[a] = sum;
      }
    });
  }

  static void prolong(const GraphLevel& level, const Vectors& coarse, Vectors& x, Vectors& before) {
    forNodes(x.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        const Row& correction = coarse[level.aggregateOf[i]];
        for (int c = 0; c < K; ++c) x[i][c] += correction[c];
        before[i] = x[i];
      }
    });
  }

  static void sweepUp(const GraphLevel& level, const Vectors& b, Vectors& x, const Vectors& before) {
    forBlocks(level, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = end; i-- > begin;) {
        Row sum = b[i];
        addEntries(level.rows, level.rows.first[i], level.insideEnd[i], x, sum);
        addEntries(level.rows, level.insideEnd[i], level.rows.first[i + 1], before, sum);
        for (int c = 0; c < K; ++c) x[i][c] = sum[c] / level.rows.diagonal[i];
      }
    });
  }

  /// image = L step, with step . image, step . b and b . b of each column.
  static std::array<double, 3 * K> applyTo(const LaplacianRows& rows, const Vectors& step, const Vectors& b,
                                           Vectors& image) {
    return sumOverNodes<3 * K>(step.size(), [&](std::uint32_t begin, std::uint32_t end, auto& sums) {
      for (std::uint32_t i = begin; i < end; ++i) {
        Row sum{};
        for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
          for (int c = 0; c < K; ++c) sum[c] += rows.weights[k] * (step[i][c] - step[rows.targets[k]][c]);
        image[i] = sum;
        for (int c = 0; c < K; ++c) {
          sums[c] += step[i][c] * sum[c];
          sums[K + c] += step[i][c] * b[i][c];
          sums[2 * K + c] += b[i][c] * b[i][c];
        }
      }
    });
  }

  /// Solves for scratch.x on a level by one or two cycles, each step as long as minimises the error in the energy norm.
  void correct(std::size_t l) {
    Scratch& s = scratch_[l];
    if (l + 1 == grid_.levels.size()) return solveCoarsest(s.b, s.x);
    const LaplacianRows& rows = grid_.levels[l].rows;
    apply(l, s.b, s.step);
    const std::array<double, 3 * K> first = applyTo(rows, s.step, s.b, s.image);
    std::array<float, K> length{};
    for (int c = 0; c < K; ++c) length[c] = first[c] > 0 ? static_cast<float>(first[K + c] / first[c]) : 0;
    const std::array<double, K> left =
        sumOverNodes<K>(s.b.size(), [&](std::uint32_t begin, std::uint32_t end, auto& sums) {
          for (std::uint32_t i = begin; i < end; ++i)
            for (int c = 0; c < K; ++c) {
              s.x[i][c] = length[c] * s.step[i][c];
              s.b[i][c] -= length[c] * s.image[i][c];
              sums[c] += s.b[i][c] * s.b[i][c];
            }
        });
    constexpr double enough = 0.25;  // of the norm of the right side (Notay & Vassilevski 2008)
    bool done = true;
    for (int c = 0; c < K; ++c) done = done && left[c] <= enough * enough * first[2 * K + c];
    if (!done) secondStep(l, first);
  }

  /// The residual is in scratch.b now; the new step is made conjugate to the first.
  void secondStep(std::size_t l, const std::array<double, 3 * K>& first) {
    Scratch& s = scratch_[l];
    const Vectors& second = s.second;
    apply(l, s.b, s.second);
    const LaplacianRows& rows = grid_.levels[l].rows;
    const std::array<double, 3 * K> sums =
        sumOverNodes<3 * K>(s.b.size(), [&](std::uint32_t begin, std::uint32_t end, auto& out) {
          for (std::uint32_t i = begin; i < end; ++i) {
            Row image{};
            for (std::uint32_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
              for (int c = 0; c < K; ++c) image[c] += rows.weights[k] * (second[i][c] - second[rows.targets[k]][c]);
            for (int c = 0; c < K; ++c) {
              out[c] += second[i][c] * image[c];
              out[K + c] += second[i][c] * s.image[i][c];
              out[2 * K + c] += second[i][c] * s.b[i][c];
            }
          }
        });
    std::array<float, K> along{}, back{};
    for (int c = 0; c < K; ++c) {
      if (!(first[c] > 0)) continue;
      const double energy = sums[c] - sums[K + c] * sums[K + c] / first[c];
      if (!(energy > 0)) continue;
      along[c] = static_cast<float>(sums[2 * K + c] / energy);
      back[c] = static_cast<float>(-sums[K + c] / first[c]) * along[c];
    }
    forNodes(s.x.size(), [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i)
        for (int c = 0; c < K; ++c) s.x[i][c] += along[c] * second[i][c] + back[c] * s.step[i][c];
    });
  }

  const GraphMultigrid& grid_;
  std::vector<Scratch> scratch_;
};

}  // namespace brisance
