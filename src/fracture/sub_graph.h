// Part of a graph, numbered so that neighbours lie close together in memory: what breadth-first cuts work on.
#pragma once

#include <tbb/scalable_allocator.h>

#include "base/raw_bytes.h"
#include "fracture/fracture_graph.h"

namespace brisance {

using Numbers = std::vector<std::uint32_t, Unset<std::uint32_t, tbb::scalable_allocator>>;

/// A connected part of a graph with numbers of its own. Made by `orderedFromAnEnd`, the numbers are a breadth-first
/// order from one end of the part, so that every prefix of them is connected.
struct SubGraph {
  Numbers names;  ///< per node: its number in the whole graph
  Numbers first, targets;
  std::vector<double> sizes;  ///< per node; empty: all one
  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(names.size()); }
};

inline double sizeOf(const SubGraph& part, std::uint32_t node) { return part.sizes.empty() ? 1 : part.sizes[node]; }
double totalSize(const SubGraph& part);

/// Numbers given by breadth-first sweeps over some nodes of a graph, and the nodes in the order of these numbers.
class Sweep {
 public:
  /// No node is open.
  explicit Sweep(std::uint32_t nodeCount) : number_(nodeCount, closed), order_(nodeCount + 1u) {}

  void open(std::uint32_t node) { number_[node] = unnumbered; }
  void openRange(std::uint32_t begin, std::uint32_t end) {
    std::fill(number_.begin() + begin, number_.begin() + end, unnumbered);
  }
  void closeAll() {
    for (std::uint32_t i = 0; i < count_; ++i) number_[order_[i]] = closed;
    count_ = 0;
  }
  void close(std::uint32_t node) { number_[node] = closed; }
  bool isOpen(std::uint32_t node) const { return number_[node] == unnumbered; }

  /// Numbers all open nodes that `start` reaches, nearest first; returns how many.
  template <class Graph>
  std::uint32_t from(std::uint32_t start, const Graph& graph);
  /// Opens all numbered nodes again.
  void reopen() {
    for (std::uint32_t i = 0; i < count_; ++i) number_[order_[i]] = unnumbered;
    count_ = 0;
  }

  std::uint32_t count() const { return count_; }
  std::span<const std::uint32_t> order() const { return {order_.data(), count_}; }

  /// The numbered nodes and the edges between them.
  SubGraph part(const SubGraph& graph) const;
  SubGraph part(const FractureGraph& graph) const;

 private:
  /// A whole graph may come in any order, each node far from the last in memory: asks for what the loop will soon read.
  void fetchAhead(const FractureGraph& graph, std::uint32_t next, std::uint32_t count) const {
    constexpr std::uint32_t step = 6;  // nodes
    if (next + 3 * step >= count) return;
    __builtin_prefetch(&graph.first[order_[next + 3 * step]]);
    __builtin_prefetch(&graph.targets[graph.first[order_[next + 2 * step]]]);
    for (const std::uint32_t target : graph.neighbours(order_[next + step])) __builtin_prefetch(&number_[target]);
  }

  static constexpr std::uint32_t closed = 0xFFFFFFFFu, unnumbered = 0xFFFFFFFEu;
  template <class Graph>
  SubGraph rows(const Graph& graph) const;

  Numbers number_;
  Numbers order_;  ///< one longer than the nodes: the loop writes before it knows
  std::uint32_t count_ = 0;
};

/// The open nodes, which `start` must all reach, as a part numbered from an end: from the last node of a sweep from
/// `start`.
template <class Graph>
SubGraph orderedFromAnEnd(const Graph& graph, Sweep& sweep, std::uint32_t start) {
  sweep.from(start, graph);
  const std::uint32_t end = sweep.order().back();
  sweep.reopen();
  sweep.from(end, graph);
  return sweep.part(graph);
}

template <class Graph>
std::uint32_t Sweep::from(std::uint32_t start, const Graph& graph) {
  // Whether a neighbour is new is a coin that no processor guesses: so every neighbour is written down, and counted
  // only where it is new.
  std::uint32_t* const number = number_.data();
  std::uint32_t* const order = order_.data();
  const std::uint32_t *const first = graph.first.data(), *const targets = graph.targets.data();
  const std::uint32_t before = count_;
  std::uint32_t count = before;
  number[start] = count;
  order[count++] = start;
  for (std::uint32_t next = before; next < count; ++next) {
    if constexpr (std::is_same_v<Graph, FractureGraph>) fetchAhead(graph, next, count);
    const std::uint32_t node = order[next], end = first[node + 1];
    for (std::uint32_t edge = first[node]; edge < end; ++edge) {
      const std::uint32_t target = targets[edge], was = number[target];
      const bool isNew = was == unnumbered;
      order[count] = target;
      number[target] = isNew ? count : was;
      count += isNew;
    }
  }
  count_ = count;
  return count - before;
}

}  // namespace brisance
