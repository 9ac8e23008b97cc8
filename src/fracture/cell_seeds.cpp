#include "fracture/cell_seeds.h"

#include <tuple>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fracture/nearest_point.h"

namespace brisance {
namespace {

/// Draws places in proportion to their weights.
class Lottery {
 public:
  explicit Lottery(const std::vector<double>& weights) {
    double sum = 0;
    for (const double weight : weights) upTo_.push_back(sum += weight);
  }
  std::uint32_t draw(double share) const {
    const auto place = std::upper_bound(upTo_.begin(), upTo_.end(), share * upTo_.back());
    return static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(place - upTo_.begin(), std::ssize(upTo_) - 1));
  }

 private:
  std::vector<double> upTo_;
};

double reachOf(const Voronoi& cells, std::span<const Vec3d> places) {
  if (!cells.impact) return 0;
  double reach = 0;
  for (const Vec3d& place : places) reach = std::max(reach, length(place - *cells.impact));
  return reach;
}

std::vector<double> densities(const Voronoi& cells, std::span<const Vec3d> places) {
  const double reach = reachOf(cells, places);
  std::vector<double> result(places.size());
  constexpr std::int64_t perTask = 16384;
  parallelFor(0, std::ssize(places), perTask, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) result[i] = cellDensity(cells, places[i], reach);
  });
  return result;
}

}  // namespace

double cellDensity(const Voronoi& cells, const Vec3d& place, double reach) {
  if (!cells.impact || cells.crowding == 0 || reach <= 0) return 1;
  constexpr double core = 0.1;  // keeps the density finite at the impact
  return portableExp(-cells.crowding * portableLog(core + length(place - *cells.impact) / reach));
}

std::vector<std::uint32_t> crowdedPoints(std::span<const Vec3d> places, std::span<const double> sizes, int count,
                                         const Voronoi& cells, std::uint64_t seed) {
  CHECK(sizes.empty() || sizes.size() == places.size(), "{} sizes for {} places", sizes.size(), places.size());
  if (count < 1 || places.empty()) return {};
  const std::vector<double> density = densities(cells, places);
  std::vector<double> weights = density;
  for (std::size_t i = 0; i < sizes.size(); ++i) weights[i] *= sizes[i];
  const Lottery lottery(weights);
  const Random random(seed, Stream::cellSeeds);
  constexpr std::uint64_t drawsEach = 8;
  std::vector<bool> taken(places.size(), false);
  GrowingPoints chosen;
  std::vector<std::uint32_t> result;
  for (std::uint64_t turn = 0; result.size() < std::min<std::size_t>(count, places.size()); ++turn) {
    std::uint32_t best = 0;
    double bestSeparation = -1;
    for (std::uint64_t draw = 0; draw < drawsEach; ++draw) {
      std::uint32_t place = lottery.draw(random.uniform(turn * drawsEach + draw));
      while (taken[place]) place = place + 1 < places.size() ? place + 1 : 0;
      const double separation = chosen.nearest(places[place]).distance2 * density[place];
      if (separation > bestSeparation) std::tie(best, bestSeparation) = std::pair(place, separation);
    }
    taken[best] = true;
    chosen.add(places[best], best);
    result.push_back(best);
  }
  return result;
}

}  // namespace brisance
