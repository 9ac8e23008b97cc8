#include "mesh/mesh_patient.h"

#include <span>
#include <tuple>

#include "base/check.h"
#include "mesh/mesh_topology.h"
#include "mesh/number_table.h"

namespace brisance {
namespace {

/// Vertices that stand for all others close to them: no two are within the distance of each other, so that a cell of
/// that size holds but a few.
class Representatives {
 public:
  Representatives(const std::vector<Vec3d>& places, double distance) : places_(places), distance_(distance) {}

  /// The nearest representative within the distance; v itself, which becomes one, where there is none.
  std::uint32_t forVertex(std::uint32_t v) {
    const Vec3d cell = cellOf(places_[v]);
    std::uint32_t nearest = v;
    double least = distance_ * distance_;
    for (int n = 0; n < 27; ++n)
      for (const std::uint32_t other : membersOf(cell + Vec3d(Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}))) {
        const Vec3d gap = places_[other] - places_[v];
        if (dot(gap, gap) < least || (dot(gap, gap) == least && nearest == v)) nearest = other, least = dot(gap, gap);
      }
    if (nearest == v) enter(cell, v);
    return nearest;
  }

 private:
  Vec3d cellOf(const Vec3d& p) const {
    return {std::floor(p.x / distance_), std::floor(p.y / distance_), std::floor(p.z / distance_)};
  }
  std::span<const std::uint32_t> membersOf(const Vec3d& cell) const {
    const std::uint32_t n = table_.find(hashOf(cell), [&](std::uint32_t other) { return cells_[other] == cell; });
    return n == NumberTable::vacant ? std::span<const std::uint32_t>{} : members_[n];
  }
  void enter(const Vec3d& cell, std::uint32_t v) {
    const auto fresh = static_cast<std::uint32_t>(cells_.size());
    const std::uint32_t n =
        table_.findOrAdd(hashOf(cell), fresh, [&](std::uint32_t other) { return cells_[other] == cell; });
    if (n == fresh) cells_.push_back(cell), members_.emplace_back();
    members_[n].push_back(v);
  }

  const std::vector<Vec3d>& places_;
  double distance_;
  NumberTable table_;
  std::vector<Vec3d> cells_;
  std::vector<std::vector<std::uint32_t>> members_;
};

bool isEven(const Triangle& t) { return (t[0] < t[1]) == (t[1] < t[2]) ? t[0] < t[1] : (t[2] < t[0]); }

/// Of triangles of the same three places: the first either way around.
struct Copies {
  std::uint32_t first[2] = {noTriangle, noTriangle};
};

}  // namespace

std::vector<Triangle> Patient::allPlaces() const {
  std::vector<Triangle> all(mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = places(t);
  return all;
}

Vec3d Patient::centre(std::size_t t) const {
  const auto& [a, b, c] = mesh.triangles[t];
  return (at(a) + at(b) + at(c)) / 3.0;
}

void Patient::keepOnly(const std::vector<bool>& keep) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (!keep[t]) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    source[kept] = source[t];
    if (!mesh.materials.empty()) mesh.materials[kept] = mesh.materials[t];
    ++kept;
  }
  mesh.triangles.resize(kept);
  source.resize(kept);
  if (!mesh.materials.empty()) mesh.materials.resize(kept);
}

void Patient::note(const char* what, const Defect& defect) {
  if (defect.count > 0) done.push_back(fmt::format("{}: {}", what, textOf(defect)));
}

/// In order of their places, so that numbering does not matter.
void weldClose(Patient& patient, double distance) {
  CHECK(std::isfinite(distance) && distance > 0, "{}", distance);
  std::vector<Vec3d>& places = patient.mesh.vertices;
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < places.size(); ++v)
    if (patient.placeOf[v] == v) order.push_back(v);
  const auto key = [&](std::uint32_t v) { return std::tie(places[v].x, places[v].y, places[v].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  Representatives representatives(places, distance);
  std::vector<std::uint32_t> chosen(places.size());
  Defect moved;
  for (const std::uint32_t v : order) {
    chosen[v] = representatives.forVertex(v);
    if (chosen[v] != v) moved.note(places[v], 0);
  }
  for (std::uint32_t& place : patient.placeOf) place = chosen[place];
  for (std::size_t v = 0; v < places.size(); ++v) places[v] = places[patient.placeOf[v]];
  if (moved.count > 0)
    patient.done.push_back(fmt::format("vertices moved to one within {} m: {}, the first at ({:.6g}, {:.6g}, {:.6g})",
                                       distance, moved.count, moved.at.x, moved.at.y, moved.at.z));
}

void dropRepeatedCorners(Patient& patient) {
  std::vector<bool> keep(patient.mesh.triangles.size(), true);
  Defect dropped;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto [a, b, c] = patient.places(t);
    keep[t] = a != b && b != c && c != a;
    if (!keep[t]) patient.count(dropped, t);
  }
  patient.note("triangles dropped that come back to a corner", dropped);
  if (dropped.count > 0) patient.keepOnly(keep);
}

void dropDuplicates(Patient& patient) {
  const std::size_t count = patient.mesh.triangles.size();
  const auto sortedPlaces = [&](std::uint32_t t) {
    Triangle places = patient.places(t);
    std::sort(places.begin(), places.end());
    return places;
  };
  NumberTable table(count);
  std::vector<Copies> copies(count);  // at the first of each set
  std::vector<std::uint32_t> firstOf(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const Triangle key = sortedPlaces(t);
    firstOf[t] = table.findOrAdd(mixHash(mixHash(key[0], key[1]), key[2]), t,
                                 [&](std::uint32_t other) { return sortedPlaces(other) == key; });
    std::uint32_t& first = copies[firstOf[t]].first[isEven(patient.places(t))];
    first = std::min(first, t);
  }
  std::vector<bool> keep(count, true);
  Defect same, opposite;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Copies& all = copies[firstOf[t]];
    const bool isOpposed = all.first[0] != noTriangle && all.first[1] != noTriangle;
    keep[t] = !isOpposed && (all.first[0] == t || all.first[1] == t);
    if (!keep[t]) patient.count(isOpposed ? opposite : same, t);
  }
  patient.note("copies of triangles dropped", same);
  patient.note("triangles dropped that lie back to back", opposite);
  if (same.count + opposite.count > 0) patient.keepOnly(keep);
}

}  // namespace brisance
