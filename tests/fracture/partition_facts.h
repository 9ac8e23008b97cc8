// What is true of a partition, told apart from those who made it; and small graphs.
#pragma once

#include <gtest/gtest.h>

#include "fracture/fracture_graph.h"

namespace brisance {

inline std::vector<int> sizes(const Partition& partition) {
  std::vector<int> result(partition.count, 0);
  for (const int piece : partition.pieceOf) ++result.at(piece);
  return result;
}

/// Islands over all pieces: as many as pieces when each is connected.
inline int islands(const FractureGraph& graph, const Partition& partition) {
  std::vector<bool> seen(graph.nodeCount(), false);
  int count = 0;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++count;
    std::vector<std::uint32_t> open{start};
    seen[start] = true;
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const std::uint32_t next : graph.neighbours(node))
        if (!seen[next] && partition.pieceOf[next] == partition.pieceOf[node]) {
          seen[next] = true;
          open.push_back(next);
        }
    }
  }
  return count;
}

inline void expectValid(const FractureGraph& graph, const Partition& partition, int pieces) {
  ASSERT_EQ(static_cast<int>(partition.pieceOf.size()), graph.nodeCount());
  EXPECT_EQ(partition.count, pieces);
  for (const int size : sizes(partition)) EXPECT_GT(size, 0);
  EXPECT_EQ(islands(graph, partition), pieces);
}

/// Largest piece over the mean.
inline double imbalance(const FractureGraph& graph, const Partition& partition) {
  std::vector<double> size(partition.count, 0);
  double total = 0;
  for (std::uint32_t node = 0; node < partition.pieceOf.size(); ++node) {
    const double own = graph.sizes.empty() ? 1 : graph.sizes[node];
    size.at(partition.pieceOf[node]) += own;
    total += own;
  }
  return *std::max_element(size.begin(), size.end()) * partition.count / total;
}

/// Weight of all edges between pieces.
inline double cutWeight(const FractureGraph& graph, const Partition& partition) {
  double twice = 0;
  for (std::uint32_t node = 0; node < partition.pieceOf.size(); ++node)
    for (std::uint32_t e = graph.first[node]; e < graph.first[node + 1]; ++e)
      if (partition.pieceOf[graph.targets[e]] != partition.pieceOf[node])
        twice += graph.weights.empty() ? 1 : graph.weights[e];
  return twice / 2;
}

/// The centroid of each triangle.
inline std::vector<Vec3d> centroids(const TriangleMesh& mesh) {
  std::vector<Vec3d> result;
  for (const auto& [a, b, c] : mesh.triangles)
    result.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
  return result;
}

/// A chain of nodes 0 - 1 - ... - n-1.
inline FractureGraph chain(std::uint32_t n) {
  FractureGraph graph;
  graph.first.push_back(0);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i > 0) graph.targets.push_back(i - 1);
    if (i + 1 < n) graph.targets.push_back(i + 1);
    graph.first.push_back(static_cast<std::uint32_t>(graph.targets.size()));
  }
  return graph;
}

/// Two graphs that nothing joins.
inline FractureGraph beside(FractureGraph graph, const FractureGraph& other) {
  const auto nodes = static_cast<std::uint32_t>(graph.nodeCount()), entries = graph.first.back();
  for (std::uint32_t node = 1; node < other.first.size(); ++node) graph.first.push_back(entries + other.first[node]);
  for (const std::uint32_t target : other.targets) graph.targets.push_back(nodes + target);
  return graph;
}

/// A lattice of width x height nodes, each joined to the next ones along both axes.
inline FractureGraph lattice(std::uint32_t width, std::uint32_t height) {
  FractureGraph graph;
  graph.first.push_back(0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t node = y * width + x;
      if (y > 0) graph.targets.push_back(node - width);
      if (x > 0) graph.targets.push_back(node - 1);
      if (x + 1 < width) graph.targets.push_back(node + 1);
      if (y + 1 < height) graph.targets.push_back(node + width);
      graph.first.push_back(static_cast<std::uint32_t>(graph.targets.size()));
      graph.places.push_back({static_cast<double>(x), static_cast<double>(y), 0});
    }
  return graph;
}

}  // namespace brisance
