#include "mesh/mesh_topology.h"

#include <atomic>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"
#include "mesh/edge_uses.h"
#include "mesh/number_table.h"

namespace brisance {
namespace {

constexpr std::int64_t slotsPerTask = 65536, verticesPerTask = 16384;

std::uint32_t lowVertex(const std::vector<Triangle>& triangles, std::uint32_t slot) {
  const Triangle& t = triangles[slot / 3];
  return std::min(t[slot % 3], t[(slot + 1) % 3]);
}

}  // namespace

EdgeRows edgeRows(const std::vector<Triangle>& triangles, std::size_t vertexCount) {
  const auto slots = static_cast<std::uint32_t>(3 * triangles.size());
  EdgeRows rows{std::vector<std::uint32_t>(vertexCount + 2, 0), std::vector<std::uint32_t>(slots)};
  // Counts go two places on, so that counting places forward leaves each row's begin where it belongs.
  const auto claim = [&](std::uint32_t vertex, int ahead) {
    return std::atomic_ref(rows.first[vertex + ahead]).fetch_add(1, std::memory_order_relaxed);
  };
  parallelFor(0, slots, slotsPerTask, [&](std::int64_t begin, std::int64_t end) {
    for (auto slot = static_cast<std::uint32_t>(begin); slot < end; ++slot) {
      const std::uint32_t vertex = triangles[slot / 3][slot % 3];
      CHECK(vertex < vertexCount, "triangle {} names vertex {} of {}", slot / 3, vertex, vertexCount);
    }
    for (auto slot = static_cast<std::uint32_t>(begin); slot < end; ++slot) claim(lowVertex(triangles, slot), 2);
  });
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  parallelFor(0, slots, slotsPerTask, [&](std::int64_t begin, std::int64_t end) {
    for (auto slot = static_cast<std::uint32_t>(begin); slot < end; ++slot)
      rows.slots[claim(lowVertex(triangles, slot), 1)] = slot;
  });
  return rows;
}

std::vector<Triangle> edgeNeighbours(const std::vector<Triangle>& triangles, std::size_t vertexCount) {
  std::vector<Triangle> neighbours(triangles.size(), Triangle{noTriangle, noTriangle, noTriangle});
  const auto join = [&](std::uint32_t low, std::span<const EdgeUse> uses) {
    if (uses[0].high == low) return;  // an edge from a vertex to itself joins nothing
    for (std::size_t i = 0; i + 1 < uses.size(); i += 2) {
      const std::uint32_t a = uses[i].slot, b = uses[i + 1].slot;
      neighbours[a / 3][a % 3] = b / 3;
      neighbours[b / 3][b % 3] = a / 3;
    }
  };
  const EdgeRows rows = edgeRows(triangles, vertexCount);
  parallelFor(0, static_cast<std::int64_t>(vertexCount), verticesPerTask,
              [&](std::int64_t from, std::int64_t to) { forEdgesOf(rows, triangles, from, to, join); });
  return neighbours;
}

std::vector<Triangle> edgeNeighbours(const TriangleMesh& mesh) {
  return edgeNeighbours(mesh.triangles, mesh.vertices.size());
}

bool isClosed(const TriangleMesh& mesh) {
  bool closed = !mesh.triangles.empty();
  forEachEdge(mesh.triangles, mesh.vertices.size(), [&](std::uint32_t low, std::span<const EdgeUse> uses) {
    closed = closed && uses[0].high != low && uses.size() == 2 && uses[0].rising != uses[1].rising;
  });
  return closed;
}

bool isWatertight(const TriangleMesh& mesh) {
  bool watertight = !mesh.triangles.empty();
  forEachEdge(mesh.triangles, mesh.vertices.size(), [&](std::uint32_t low, std::span<const EdgeUse> uses) {
    const auto rising = std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.rising; });
    watertight = watertight && uses[0].high != low && 2 * rising == static_cast<std::ptrdiff_t>(uses.size());
  });
  return watertight;
}

std::vector<std::uint32_t> samePlaces(const std::vector<Vec3d>& places) {
  NumberTable table(places.size());
  std::vector<std::uint32_t> first(places.size());
  for (std::uint32_t v = 0; v < first.size(); ++v)
    first[v] = table.findOrAdd(hashOf(places[v]), v, [&](std::uint32_t other) { return places[other] == places[v]; });
  return first;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result{mesh.vertices, mesh.triangles, {}, {}, {}, {}};
  const std::vector<std::uint32_t> first = samePlaces(mesh.vertices);
  for (Triangle& t : result.triangles)
    for (std::uint32_t& v : t) v = first[v];
  return result;
}

int componentCount(const TriangleMesh& mesh) {
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<std::uint32_t> open;
  int count = 0;
  for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
    if (seen[start]) continue;
    ++count;
    seen[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t triangle = open.back();
      open.pop_back();
      for (const std::uint32_t next : neighbours[triangle]) {
        if (next == noTriangle || seen[next]) continue;
        seen[next] = true;
        open.push_back(next);
      }
    }
  }
  return count;
}

}  // namespace brisance
