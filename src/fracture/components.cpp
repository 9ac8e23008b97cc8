#include "fracture/components.h"

#include <queue>

namespace brisance {
namespace {

/// Nodes [begin, end) of a graph, which no edge leaves.
SubGraph slice(const SubGraph& graph, std::uint32_t begin, std::uint32_t end) {
  SubGraph part;
  part.names.assign(graph.names.begin() + begin, graph.names.begin() + end);
  if (!graph.sizes.empty()) part.sizes.assign(graph.sizes.begin() + begin, graph.sizes.begin() + end);
  const std::uint32_t firstEntry = graph.first[begin];
  for (std::uint32_t node = begin; node <= end; ++node) part.first.push_back(graph.first[node] - firstEntry);
  for (std::uint32_t entry = firstEntry; entry < graph.first[end]; ++entry)
    part.targets.push_back(graph.targets[entry] - begin);
  return part;
}

}  // namespace

std::vector<SubGraph> componentsOf(const FractureGraph& graph) {
  const auto nodes = static_cast<std::uint32_t>(graph.nodeCount());
  Sweep sweep(nodes);
  sweep.openRange(0, nodes);
  std::vector<std::uint32_t> begins{0};
  for (std::uint32_t node = 0; node < nodes; ++node)
    if (sweep.isOpen(node)) begins.push_back(begins.back() + sweep.from(node, graph));
  SubGraph all = sweep.part(graph);
  std::vector<SubGraph> result;
  if (begins.size() == 2) {
    result.push_back(std::move(all));
    return result;
  }
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) result.push_back(slice(all, begins[i], begins[i + 1]));
  return result;
}

std::vector<int> sharePieces(const std::vector<SubGraph>& parts, int pieces) {
  std::vector<int> result(parts.size(), 1);
  std::priority_queue<std::pair<double, std::int64_t>> wanting;  // of equals the one that comes first
  const auto enter = [&](std::int64_t part) {
    if (result[part] < static_cast<int>(parts[part].nodeCount()))
      wanting.push({totalSize(parts[part]) / result[part], -part});
  };
  for (std::int64_t part = 0; part < static_cast<std::int64_t>(parts.size()); ++part) enter(part);
  for (auto given = static_cast<int>(parts.size()); given < pieces; ++given) {
    const std::int64_t part = -wanting.top().second;
    wanting.pop();
    ++result[part];
    enter(part);
  }
  return result;
}

}  // namespace brisance
