#include "mesh/self_crossing.h"

#include "base/parallel.h"
#include "mesh/box_tree.h"

namespace brisance {
namespace {

/// Boxes looked at: shared out in all, and for each triangle; a well-made mesh needs some eighty for each.
constexpr std::size_t mostBoxes = 8'000'000, boxesPerTriangle = 256;
constexpr std::int64_t blockSize = 4096;
constexpr double certain = 1e-11;  // of the cube of the length: a volume that rounding cannot make

/// Six times the signed volume of a tetrahedron; 0 where its sign is in doubt.
double clearVolume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Vec3d u = b - a, v = c - a, w = d - a;
  const double volume = dot(u, cross(v, w));
  return std::abs(volume) > certain * length(u) * length(v) * length(w) ? volume : 0;
}

using Corners = std::array<Vec3d, 3>;

/// Whether the inside of segment p q clearly goes through the inside of a triangle.
bool pierces(const Vec3d& p, const Vec3d& q, const Corners& t) {
  const double before = clearVolume(t[0], t[1], t[2], p), after = clearVolume(t[0], t[1], t[2], q);
  if (!(before * after < 0)) return false;
  const double a = clearVolume(p, q, t[0], t[1]), b = clearVolume(p, q, t[1], t[2]), c = clearVolume(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

class Search {
 public:
  explicit Search(const TriangleMesh& surface) : surface_(surface), tree_(boxes(surface)) {}

  SelfCrossing run() const {
    const auto count = static_cast<std::int64_t>(surface_.triangles.size());
    const std::int64_t blocks = (count + blockSize - 1) / blockSize;
    std::vector<SelfCrossing> found(static_cast<std::size_t>(blocks));
    const std::size_t share = mostBoxes / static_cast<std::size_t>(std::max<std::int64_t>(blocks, 1)) +
                              boxesPerTriangle * static_cast<std::size_t>(blockSize);
    parallelFor(0, blocks, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t b = begin; b < end; ++b)
        found[static_cast<std::size_t>(b)] = block(b * blockSize, std::min(count, (b + 1) * blockSize), share);
    });
    SelfCrossing sum;
    for (const SelfCrossing& part : found) {
      if (sum.pairs == 0) sum.triangle = part.triangle;
      sum.pairs += part.pairs;
      sum.all = sum.all && part.all;
    }
    return sum;
  }

 private:
  static std::vector<Box3> boxes(const TriangleMesh& surface) {
    std::vector<Box3> boxes;
    boxes.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) boxes.push_back(boxOf(surface, t));
    return boxes;
  }

  SelfCrossing block(std::int64_t begin, std::int64_t end, std::size_t share) const {
    SelfCrossing found;
    std::size_t looked = 0;
    for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t) {
      const Box3 box = boxOf(surface_, surface_.triangles[t]);
      looked += tree_.search([&](const Box3& other) { return overlap(box, other); },
                             [&](std::uint32_t other) {
                               if (other > t && cross(t, other) && found.pairs++ == 0) found.triangle = t;
                               return ++looked < share;
                             });
      found.all = looked < share;
      if (!found.all) break;
    }
    return found;
  }

  Corners cornersOf(const Triangle& t) const {
    return {surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]};
  }

  /// An edge from a corner that both share touches there and is not asked.
  bool edgesPierce(const Triangle& edges, const Triangle& t) const {
    const auto shared = [&](std::uint32_t v) { return v == t[0] || v == t[1] || v == t[2]; };
    const Corners corners = cornersOf(t);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t p = edges[e], q = edges[(e + 1) % 3];
      if (!shared(p) && !shared(q) && pierces(surface_.vertices[p], surface_.vertices[q], corners)) return true;
    }
    return false;
  }

  bool cross(std::uint32_t first, std::uint32_t second) const {
    const Triangle &a = surface_.triangles[first], &b = surface_.triangles[second];
    return edgesPierce(a, b) || edgesPierce(b, a);
  }

  const TriangleMesh& surface_;
  BoxTree tree_;
};

}  // namespace

Box3 boxOf(const TriangleMesh& mesh, const Triangle& t) {
  Box3 box;
  for (const std::uint32_t v : t) box.include(mesh.vertices[v]);
  return box;
}

SelfCrossing selfCrossing(const TriangleMesh& surface) { return Search(surface).run(); }

}  // namespace brisance
