#include <limits>

#include "base/check.h"
#include "mesh/edge_uses.h"
#include "mesh/mesh_patient.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

/// One corner of a hole: the open edge from here goes on to the next corner, against its triangle's direction.
struct Rim {
  std::uint32_t vertex = 0, triangle = 0, next = 0;  ///< next: the place of the next corner
};

class HoleFilling {
 public:
  HoleFilling(Patient& patient, std::size_t mostEdges) : patient_(patient), mostEdges_(mostEdges) {}

  bool run() {
    findRims();
    Defect filled;
    std::vector<bool> seen(rimAt_.size());
    for (std::uint32_t place = 0; place < rimAt_.size(); ++place) {
      const std::vector<std::uint32_t> loop = loopFrom(place, seen);
      if (loop.size() < 3) continue;
      filled.note(patient_.at(place), patient_.source[rims_[loop[0]].triangle]);
      fill(loop);
    }
    patient_.note("holes closed", filled);
    return filled.count > 0;
  }

 private:
  static constexpr std::uint32_t none = noTriangle, several = noTriangle - 1;

  void findRims() {
    rimAt_.assign(patient_.mesh.vertices.size(), none);
    const std::vector<Triangle> places = patient_.allPlaces();
    forEachEdge(places, rimAt_.size(), [&](std::uint32_t, std::span<const EdgeUse> uses) {
      if (uses.size() != 1) return;
      const std::uint32_t t = uses[0].slot / 3, e = uses[0].slot % 3, from = places[t][(e + 1) % 3];
      rimAt_[from] = rimAt_[from] == none ? static_cast<std::uint32_t>(rims_.size()) : several;
      rims_.push_back({patient_.mesh.triangles[t][(e + 1) % 3], t, places[t][e]});
    });
  }

  /// The rims around the hole; empty where it is too long, touches itself, or was seen.
  std::vector<std::uint32_t> loopFrom(std::uint32_t start, std::vector<bool>& seen) const {
    std::vector<std::uint32_t> loop;
    std::uint32_t place = start;
    while (rimAt_[place] < several && !seen[place] && loop.size() <= mostEdges_) {
      loop.push_back(rimAt_[place]);
      seen[place] = true;
      place = rims_[loop.back()].next;
      if (place == start) return loop.size() <= mostEdges_ ? loop : std::vector<std::uint32_t>{};
    }
    return {};
  }

  double areaOf(const std::vector<std::uint32_t>& loop, std::size_t i, std::size_t k, std::size_t j) const {
    const Vec3d &a = patient_.at(rims_[loop[i]].vertex), &b = patient_.at(rims_[loop[k]].vertex);
    return length(cross(b - a, patient_.at(rims_[loop[j]].vertex) - a));
  }

  /// The triangulation of least area (Barequet & Sharir 1995), by growing spans of corners.
  void fill(const std::vector<std::uint32_t>& loop) {
    const std::size_t n = loop.size();
    std::vector<double> least(n * n, 0);
    std::vector<std::size_t> apex(n * n, 0);
    for (std::size_t span = 2; span < n; ++span)
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t j = i + span;
        least[i * n + j] = std::numeric_limits<double>::infinity();
        for (std::size_t k = i + 1; k < j; ++k) {
          const double area = least[i * n + k] + least[k * n + j] + areaOf(loop, i, k, j);
          if (area < least[i * n + j] || k == i + 1) least[i * n + j] = area, apex[i * n + j] = k;
        }
      }
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = apex[i * n + j];
      add(rims_[loop[i]], rims_[loop[k]], rims_[loop[j]]);
      open.push_back({i, k});
      open.push_back({k, j});
    }
  }

  void add(const Rim& a, const Rim& b, const Rim& c) {
    patient_.mesh.triangles.push_back({a.vertex, b.vertex, c.vertex});
    patient_.source.push_back(noTriangle);
    if (!patient_.mesh.materials.empty())
      patient_.mesh.materials.push_back(std::uint16_t{patient_.mesh.materials[a.triangle]});
  }

  Patient& patient_;
  std::size_t mostEdges_;
  std::vector<Rim> rims_;
  std::vector<std::uint32_t> rimAt_;  ///< per place
};

}  // namespace

bool fillHoles(Patient& patient, std::size_t mostEdges) {
  CHECK(mostEdges <= mostHoleEdges, "{}", mostEdges);
  return HoleFilling(patient, mostEdges).run();
}

}  // namespace brisance
