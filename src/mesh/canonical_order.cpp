#include "mesh/canonical_order.h"

#include <tuple>

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {
namespace {

constexpr int bitsPerAxis = 21;  // three axes fill 63 bits of a key

/// Two zero bits after each of the lowest 21.
std::uint64_t spread(std::uint64_t bits) {
  bits &= (1u << bitsPerAxis) - 1;
  bits = (bits | bits << 32) & 0x1F00000000FFFFu;
  bits = (bits | bits << 16) & 0x1F0000FF0000FFu;
  bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

struct KeyedVertex {
  std::uint64_t key;
  std::uint32_t vertex;
};

class MortonKeys {
 public:
  explicit MortonKeys(const Box3& box) : lower_(box.lower) {
    const Vec3d size = box.size();
    const double side = std::max({size.x, size.y, size.z});
    scale_ = side > 0 ? ((1 << bitsPerAxis) - 1) / side : 0;
  }
  std::uint64_t operator()(const Vec3d& place) const {
    const Vec3d cell = (place - lower_) * scale_;
    const auto part = [](double x) { return spread(static_cast<std::uint64_t>(x)); };
    return part(cell.x) << 2 | part(cell.y) << 1 | part(cell.z);
  }

 private:
  Vec3d lower_;
  double scale_;
};

std::vector<bool> usedVertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      CHECK(v < used.size(), "vertex {} of {}", v, used.size());
      used[v] = true;
    }
  return used;
}

/// Used vertices in canonical order.
std::vector<KeyedVertex> sortedVertices(const TriangleMesh& mesh) {
  const std::vector<bool> used = usedVertices(mesh);
  Box3 box;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) box.include(mesh.vertices[v]);
  const MortonKeys key(box);
  std::vector<KeyedVertex> vertices;
  vertices.reserve(used.size());
  for (std::uint32_t v = 0; v < used.size(); ++v)
    if (used[v]) vertices.push_back({key(mesh.vertices[v]), v});
  const auto before = [&](const KeyedVertex& a, const KeyedVertex& b) {
    if (a.key != b.key) return a.key < b.key;
    const Vec3d &p = mesh.vertices[a.vertex], &q = mesh.vertices[b.vertex];
    return std::tie(p.x, p.y, p.z, a.vertex) < std::tie(q.x, q.y, q.z, b.vertex);
  };
  const auto middle = vertices.begin() + static_cast<std::ptrdiff_t>(vertices.size() / 2);
  parallelFor(0, 2, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t half = first; half < last; ++half)
      half == 0 ? std::sort(vertices.begin(), middle, before) : std::sort(middle, vertices.end(), before);
  });
  std::inplace_merge(vertices.begin(), middle, vertices.end(), before);
  return vertices;
}

struct NumberedTriangle {
  Triangle corners;
  std::uint32_t number;
  auto operator<=>(const NumberedTriangle&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The corners as they follow one another, the lowest first.
Triangle fromLowest(const Triangle& t) {
  const auto lowest = std::min_element(t.begin(), t.end()) - t.begin();
  return {t[lowest], t[(lowest + 1) % 3], t[(lowest + 2) % 3]};
}

/// By first corner with a counting sort, then the few around each corner.
std::vector<NumberedTriangle> sortedTriangles(const std::vector<Triangle>& triangles, std::size_t vertexCount) {
  std::vector<std::uint32_t> first(vertexCount + 1, 0);
  for (const Triangle& t : triangles) ++first[fromLowest(t)[0] + 1];
  for (std::size_t v = 0; v < vertexCount; ++v) first[v + 1] += first[v];
  std::vector<NumberedTriangle> sorted(triangles.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Triangle corners = fromLowest(triangles[t]);
    sorted[next[corners[0]]++] = {corners, t};
  }
  constexpr std::int64_t grain = 4096;
  parallelFor(0, static_cast<std::int64_t>(vertexCount), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) std::sort(sorted.begin() + first[v], sorted.begin() + first[v + 1]);
  });
  return sorted;
}

}  // namespace

OrderedSurface inCanonicalOrder(const TriangleMesh& mesh) {
  OrderedSurface ordered;
  std::vector<std::uint32_t> newNumber(mesh.vertices.size());
  for (const KeyedVertex& v : sortedVertices(mesh)) {
    newNumber[v.vertex] = static_cast<std::uint32_t>(ordered.mesh.vertices.size());
    ordered.mesh.vertices.push_back(mesh.vertices[v.vertex]);
  }
  std::vector<Triangle> renumbered;
  renumbered.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) renumbered.push_back({newNumber[a], newNumber[b], newNumber[c]});
  for (const NumberedTriangle& t : sortedTriangles(renumbered, ordered.mesh.vertices.size())) {
    ordered.mesh.triangles.push_back(t.corners);
    ordered.triangleOf.push_back(t.number);
  }
  return ordered;
}

}  // namespace brisance
