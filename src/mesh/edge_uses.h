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

inline EdgeUse edgeUse(const std::vector<Triangle>& triangles, std::uint32_t slot) {
  const Triangle& t = triangles[slot / 3];
  const std::uint32_t a = t[slot % 3], b = t[(slot + 1) % 3];
  return {std::max(a, b), slot, a < b};
}

/// All uses of edges by their slots, in rows by the lesser vertex: a counting sort, so linear in the number of
/// triangles. Threads fill rows in any order: what reads a row sorts it first.
struct EdgeRows {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> slots;
};
EdgeRows edgeRows(const std::vector<Triangle>& triangles, std::size_t vertexCount);

/// Calls visit(low vertex, uses of one edge in order of slots) for every edge whose lesser vertex is in [from, to).
template <class Visit>
void forEdgesOf(const EdgeRows& rows, const std::vector<Triangle>& triangles, std::size_t from, std::size_t to,
                const Visit& visit) {
  std::vector<EdgeUse> uses;
  const auto earlier = [](const EdgeUse& a, const EdgeUse& b) {
    return a.high != b.high ? a.high < b.high : a.slot < b.slot;
  };
  for (std::size_t v = from; v < to; ++v) {
    uses.clear();
    for (std::uint32_t i = rows.first[v]; i < rows.first[v + 1]; ++i) uses.push_back(edgeUse(triangles, rows.slots[i]));
    std::sort(uses.begin(), uses.end(), earlier);
    for (auto group = uses.begin(); group != uses.end();) {
      const auto next = std::find_if(group, uses.end(), [&](const EdgeUse& use) { return use.high != group->high; });
      visit(static_cast<std::uint32_t>(v), std::span<const EdgeUse>(group, next));
      group = next;
    }
  }
}

/// Likewise for every edge.
template <class Visit>
void forEachEdge(const std::vector<Triangle>& triangles, std::size_t vertexCount, const Visit& visit) {
  forEdgesOf(edgeRows(triangles, vertexCount), triangles, 0, vertexCount, visit);
}

/// The corner (3 triangle + corner) at which the use's triangle has the edge's lesser or greater vertex.
inline std::uint32_t lowCorner(const EdgeUse& use) {
  return use.slot / 3 * 3 + (use.rising ? use.slot % 3 : (use.slot + 1) % 3);
}
inline std::uint32_t highCorner(const EdgeUse& use) {
  return use.slot / 3 * 3 + (use.rising ? (use.slot + 1) % 3 : use.slot % 3);
}

}  // namespace brisance
