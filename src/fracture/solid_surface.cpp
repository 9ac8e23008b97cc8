#include "fracture/solid_surface.h"

#include <numeric>
#include <tuple>

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/distinct_places.h"
#include "mesh/disjoint_sets.h"

namespace brisance {
namespace {

/// Differences of two places need 52 bits.
double placeStep(const TriangleMesh& mesh) {
  const Box3 box = bounds(mesh);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max({largest, -box.lower[axis], box.upper[axis]});
  return std::ldexp(1.0, std::ilogb(largest) - 50);
}

/// For every vertex the first at the same place.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3d>& places) {
  std::vector<std::uint32_t> order(places.size()), first(places.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) { return std::tie(places[v].x, places[v].y, places[v].z); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (std::size_t n = 0; n < order.size(); ++n)
    first[order[n]] = n > 0 && key(order[n - 1]) == key(order[n]) ? first[order[n - 1]] : order[n];
  return first;
}

/// An edge's use: slot = 3 triangle + edge.
struct EdgeUse {
  std::uint32_t high, slot;
  bool rising;
};

/// Joins the corners of triangles that lie on both sides of an edge; a slot also names the corner where its edge
/// starts.
class Fans {
 public:
  Fans(const std::vector<Triangle>& triangles, std::size_t vertexCount)
      : triangles_(triangles), corners_(3 * triangles.size()), first_(vertexCount + 1, 0) {
    sortUses();
    for (std::size_t v = 0; v < vertexCount; ++v) joinEdgesOf(v);
  }
  std::uint32_t fanOf(std::uint32_t slot) { return corners_.root(slot); }

 private:
  void sortUses() {
    const auto slots = static_cast<std::uint32_t>(3 * triangles_.size());
    for (std::uint32_t slot = 0; slot < slots; ++slot) ++first_[low(slot) + 1];
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    uses_.resize(slots);
    for (std::uint32_t slot = 0; slot < slots; ++slot)
      uses_[next[low(slot)]++] = {std::max(start(slot), end(slot)), slot, start(slot) < end(slot)};
  }
  std::uint32_t start(std::uint32_t slot) const { return triangles_[slot / 3][slot % 3]; }
  std::uint32_t end(std::uint32_t slot) const { return triangles_[slot / 3][(slot + 1) % 3]; }
  std::uint32_t low(std::uint32_t slot) const { return std::min(start(slot), end(slot)); }

  /// Pairs the uses of each edge, rising with falling, in order.
  void joinEdgesOf(std::size_t vertex) {
    const auto begin = uses_.begin() + static_cast<std::ptrdiff_t>(first_[vertex]);
    const auto end = uses_.begin() + static_cast<std::ptrdiff_t>(first_[vertex + 1]);
    std::sort(begin, end, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.rising, a.slot) < std::tie(b.high, b.rising, b.slot);
    });
    for (auto group = begin; group != end;) {
      const auto next = std::find_if(group, end, [&](const EdgeUse& use) { return use.high != group->high; });
      const auto rising = std::find_if(group, next, [](const EdgeUse& use) { return use.rising; });
      if (rising - group != next - rising)
        throw InputError(
            fmt::format("solid: triangle {}: the mesh must be closed and oriented, but an edge has no "
                        "counterpart",
                        group->slot / 3));
      for (auto up = rising, down = group; up != next; ++up, ++down) joinAcross(up->slot, down->slot);
      group = next;
    }
  }
  void joinAcross(std::uint32_t up, std::uint32_t down) {
    const auto following = [](std::uint32_t slot) { return slot - slot % 3 + (slot + 1) % 3; };
    corners_.join(up, following(down));
    corners_.join(following(up), down);
  }

  const std::vector<Triangle>& triangles_;
  DisjointSets corners_;
  std::vector<std::size_t> first_;
  std::vector<EdgeUse> uses_;
};

/// One vertex per fan, numbered as triangles name them, each at a place of its own.
void splitFans(SolidSurface& surface, const std::vector<Vec3d>& places) {
  Fans fans(surface.triangles, places.size());
  std::vector<std::uint32_t> numberOf(3 * surface.triangles.size(), noVertex);
  std::vector<bool> placeUsed(places.size(), false);
  std::vector<std::uint32_t> doubled;
  for (std::uint32_t slot = 0; slot < numberOf.size(); ++slot) {
    std::uint32_t& vertex = surface.triangles[slot / 3][slot % 3];
    std::uint32_t& number = numberOf[fans.fanOf(slot)];
    if (number == noVertex) {
      number = static_cast<std::uint32_t>(surface.places.size());
      if (placeUsed[vertex]) doubled.push_back(number);
      placeUsed[vertex] = true;
      surface.places.push_back(places[vertex]);
    }
    vertex = number;
  }
  if (doubled.empty()) return;
  DistinctPlaces distinct(surface.step);
  std::vector<bool> isDoubled(surface.places.size(), false);
  for (const std::uint32_t v : doubled) isDoubled[v] = true;
  for (std::uint32_t v = 0; v < surface.places.size(); ++v)
    if (!isDoubled[v]) distinct.take(surface.places[v]);
  for (const std::uint32_t v : doubled) surface.places[v] = distinct.take(surface.places[v]);
}

}  // namespace

Vec3d onSteps(const Vec3d& place, double step) {
  // + 0.0 turns a negative zero into the one zero.
  return {std::nearbyint(place.x / step) * step + 0.0, std::nearbyint(place.y / step) * step + 0.0,
          std::nearbyint(place.z / step) * step + 0.0};
}

SolidSurface solidSurface(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("solid: the mesh must have triangles, got none");
  SolidSurface surface;
  surface.step = placeStep(mesh);
  std::vector<Vec3d> places(mesh.vertices.size());
  for (std::size_t v = 0; v < places.size(); ++v) places[v] = onSteps(mesh.vertices[v], surface.step);
  const std::vector<std::uint32_t> first = firstAtPlace(places);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const Triangle triangle{first[corners[0]], first[corners[1]], first[corners[2]]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    surface.triangles.push_back(triangle);
    surface.corners.push_back(corners);
    surface.faces.push_back(t);
  }
  splitFans(surface, places);
  return surface;
}

}  // namespace brisance
