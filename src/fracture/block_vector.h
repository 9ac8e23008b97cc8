// A few vectors over the nodes of a graph, side by side, and sums over them that do not depend on the number of
// threads.
#pragma once

#include <array>
#include <cstdint>

#include "base/aligned.h"
#include "base/parallel.h"

namespace brisance {

/// K numbers per node.
template <int K, class Real>
using BlockVector = AlignedVector<std::array<Real, K>>;

constexpr std::int64_t nodesAtOnce = 8192;  ///< rows that one thread takes at a time

/// body(first, last) over blocks of nodes, on any thread.
template <class Body>
void forNodes(std::size_t count, const Body& body) {
  parallelFor(0, static_cast<std::int64_t>(count), nodesAtOnce, [&](std::int64_t first, std::int64_t last) {
    body(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
  });
}

/// N sums at once: body(first, last, sums) adds what its nodes hold; blocks are fixed and added in their order.
template <std::size_t N, class Body>
std::array<double, N> sumOverNodes(std::size_t count, const Body& body) {
  const std::size_t blockSize = nodesAtOnce, blocks = (count + blockSize - 1) / blockSize;
  std::vector<std::array<double, N>> parts(blocks);
  parallelFor(0, static_cast<std::int64_t>(blocks), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end); ++b) {
      std::array<double, N> sums{};
      body(static_cast<std::uint32_t>(b * blockSize), static_cast<std::uint32_t>(std::min(count, (b + 1) * blockSize)),
           sums);
      parts[b] = sums;
    }
  });
  std::array<double, N> total{};
  for (const auto& part : parts)
    for (std::size_t i = 0; i < N; ++i) total[i] += part[i];
  return total;
}

}  // namespace brisance
