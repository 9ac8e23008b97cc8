// Which triangles use an edge, and which way.
#pragma once

#include <algorithm>
#include <span>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// One triangle's use of an edge: slot = 3 triangle + edge; edge e joins corners e and e + 1.
struct EdgeUse {
  std::uint32_t high = 0;  ///< the greater of the edge's vertices
  std::uint32_t slot = 0;
  bool rising = false;  ///< goes from the lesser vertex to the greater
};

/// All uses of edges, in rows by the lesser vertex: a counting sort, so linear in the number of triangles.
struct EdgeRows {
  std::vector<std::size_t> first;
  std::vector<EdgeUse> uses;
};
EdgeRows edgeRows(const std::vector<Triangle>& triangles, std::size_t vertexCount);

/// Calls visit(low vertex, uses of one edge in order of slots) for every edge.
template <class Visit>
void forEachEdge(const std::vector<Triangle>& triangles, std::size_t vertexCount, const Visit& visit) {
  EdgeRows rows = edgeRows(triangles, vertexCount);
  for (std::size_t v = 0; v < vertexCount; ++v) {
    const auto begin = rows.uses.begin() + static_cast<std::ptrdiff_t>(rows.first[v]);
    const auto end = rows.uses.begin() + static_cast<std::ptrdiff_t>(rows.first[v + 1]);
    std::sort(begin, end,
              [](const EdgeUse& a, const EdgeUse& b) { return a.high != b.high ? a.high < b.high : a.slot < b.slot; });
    for (auto group = begin; group != end;) {
      const auto next = std::find_if(group, end, [&](const EdgeUse& use) { return use.high != group->high; });
      visit(static_cast<std::uint32_t>(v), std::span<const EdgeUse>(group, next));
      group = next;
    }
  }
}

/// The corner (3 triangle + corner) at which the use's triangle has the edge's lesser or greater vertex.
inline std::uint32_t lowCorner(const EdgeUse& use) {
  return use.slot / 3 * 3 + (use.rising ? use.slot % 3 : (use.slot + 1) % 3);
}
inline std::uint32_t highCorner(const EdgeUse& use) {
  return use.slot / 3 * 3 + (use.rising ? (use.slot + 1) % 3 : use.slot % 3);
}

}  // namespace brisance
