#include "fracture/cell_diagram.h"

#include "base/check.h"

namespace brisance {
namespace {

/// At the corners of a tetrahedron around the box, four times its half size and more away: no point of the box is as
/// far from its own seed.
std::array<WeightedSeed, 4> ghosts() {
  constexpr std::int64_t far = std::int64_t{1} << (seedBits + 2);
  return {WeightedSeed{{far, far, far}, 0}, {{far, -far, -far}, 0}, {{-far, far, -far}, 0}, {{-far, -far, far}, 0}};
}

}  // namespace

CellDiagram::CellDiagram(std::vector<WeightedSeed> seeds)
    : cellCount_(static_cast<std::uint32_t>(seeds.size())), seeds_(std::move(seeds)) {
  const auto around = ghosts();
  seeds_.insert(seeds_.end(), around.begin(), around.end());
  tetrahedra_ = powerTriangulation(seeds_);
  for (std::uint32_t cell = 0; cell < cellCount_; ++cell) {
    const auto& [place, weight] = seeds_[cell];
    twice_.push_back(place * std::int64_t{2});
    constant_.push_back((dot(place, place) - weight) * (std::int64_t{1} << vertexBits));
  }
  findNeighbours();
}

void CellDiagram::findNeighbours() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Tetrahedron& t : tetrahedra_)
    for (const std::uint32_t a : t.seeds) {
      if (isGhost(a)) continue;
      visible_ = std::min(visible_, a);
      for (const std::uint32_t b : t.seeds)
        if (a != b && !isGhost(b)) pairs.push_back({a, b});
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_.assign(cellCount_ + 1, 0);
  for (const auto& [cell, target] : pairs) {
    ++first_[cell + 1];
    targets_.push_back(target);
  }
  for (std::uint32_t cell = 0; cell < cellCount_; ++cell) first_[cell + 1] += first_[cell];
}

std::uint32_t CellDiagram::cellOf(const Vec3l& vertex, std::uint32_t start) const {
  std::uint32_t cell = start == noCell ? visible_ : start;
  for (;;) {
    const std::int64_t here = power(cell, vertex);
    std::uint32_t next = cell;
    std::int64_t least = here;
    for (const std::uint32_t other : neighbours(cell)) {
      const std::int64_t there = power(other, vertex);
      if (there < least) {
        least = there;
        next = other;
      } else if (there == here) {
        throw Coincidence{};
      }
    }
    if (next == cell) return cell;
    cell = next;
  }
}

Vec3d CellDiagram::meetingPoint(const Tetrahedron& tetrahedron) const {
  // 2 (p_n - p_0) . x = (|p_n|^2 - w_n) - (|p_0|^2 - w_0), n = 1, 2, 3, about p_0 by Cramer's rule.
  const WeightedSeed& base = seeds_[tetrahedron.seeds[0]];
  std::array<Vec3<Int128>, 3> side;
  std::array<Int128, 3> height;
  for (int n = 0; n < 3; ++n) {
    const WeightedSeed& seed = seeds_[tetrahedron.seeds[n + 1]];
    const Vec3l difference = seed.place - base.place;
    side[n] = Vec3<Int128>(difference);
    height[n] = dot(difference, difference) - seed.weight + base.weight;
  }
  const Vec3<Int128> sum =
      cross(side[1], side[2]) * height[0] + cross(side[2], side[0]) * height[1] + cross(side[0], side[1]) * height[2];
  const double twiceVolume = 2 * static_cast<double>(dot(side[0], cross(side[1], side[2])));
  return Vec3d(base.place) + Vec3d(sum) / twiceVolume;
}

}  // namespace brisance
