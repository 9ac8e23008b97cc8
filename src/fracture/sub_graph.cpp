#include "fracture/sub_graph.h"

#include <numeric>

namespace brisance {
namespace {

std::uint32_t nameOf(const SubGraph& graph, std::uint32_t node) { return graph.names[node]; }
std::uint32_t nameOf(const FractureGraph&, std::uint32_t node) { return node; }

}  // namespace

double totalSize(const SubGraph& part) {
  return part.sizes.empty() ? part.nodeCount() : std::accumulate(part.sizes.begin(), part.sizes.end(), 0.0);
}

template <class Graph>
SubGraph Sweep::rows(const Graph& graph) const {
  SubGraph part;
  part.names.resize(count_);
  part.first.resize(count_ + 1u);
  std::size_t entries = 0;
  for (const std::uint32_t node : order()) entries += graph.first[node + 1] - graph.first[node];
  part.targets.resize(entries + 1);  // one more: written before it is known whether it belongs
  std::uint32_t* const targets = part.targets.data();
  std::uint32_t used = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const std::uint32_t node = order_[i];
    part.names[i] = nameOf(graph, node);
    part.first[i] = used;
    for (std::uint32_t edge = graph.first[node]; edge < graph.first[node + 1]; ++edge) {
      const std::uint32_t number = number_[graph.targets[edge]];
      targets[used] = number;
      used += number < unnumbered;
    }
  }
  part.first[count_] = used;
  part.targets.resize(used);
  if (!graph.sizes.empty())
    for (const std::uint32_t node : order()) part.sizes.push_back(graph.sizes[node]);
  return part;
}

SubGraph Sweep::part(const SubGraph& graph) const { return rows(graph); }
SubGraph Sweep::part(const FractureGraph& graph) const { return rows(graph); }

}  // namespace brisance
