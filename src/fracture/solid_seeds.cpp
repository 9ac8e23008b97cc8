#include "fracture/solid_seeds.h"

#include "base/check.h"
#include "base/random.h"
#include "fracture/cell_seeds.h"

namespace brisance {
namespace {

/// The parts of lines along z that lie inside a body: one line at a random place in each square of a lattice in x and
/// y.
class InsideLines {
 public:
  InsideLines(const SolidSurface& surface, int side, const Random& random) : side_(side), surface_(surface) {
    for (const Vec3d& p : surface.places) box_.include(p);
    for (int n = 0; n < side * side; ++n) lines_.push_back({{random.uniform(2 * n), random.uniform(2 * n + 1)}, {}});
    for (const Triangle& t : surface.triangles) cross(t);
    collect();
  }

  double length() const { return ends_.empty() ? 0 : ends_.back(); }
  /// The point at a given length along all stretches, one after the other.
  Vec3d at(double along) const {
    const auto stretch =
        static_cast<std::size_t>(std::min(std::upper_bound(ends_.begin(), ends_.end(), along) - ends_.begin(),
                                          static_cast<std::ptrdiff_t>(ends_.size()) - 1));
    const auto& [place, top] = stretches_[stretch];
    return {place.x, place.y, top - (ends_[stretch] - along)};
  }

 private:
  struct Line {
    Vec2d offset;                                   ///< in its square, 0 to 1
    std::vector<std::pair<double, int>> crossings;  ///< z, and +1 where it enters
  };
  Vec2d place(int i, int j) const {
    const Vec2d& offset = lines_[j * side_ + i].offset;
    return {box_.lower.x + box_.size().x * (i + offset.x) / side_,
            box_.lower.y + box_.size().y * (j + offset.y) / side_};
  }
  int square(double x, int axis) const {
    const double share = (x - box_.lower[axis]) / box_.size()[axis];
    return std::clamp(static_cast<int>(share * side_), 0, side_ - 1);
  }

  void cross(const Triangle& t) {
    const Vec3d &a = surface_.places[t[0]], &b = surface_.places[t[1]], &c = surface_.places[t[2]];
    const int i0 = square(std::min({a.x, b.x, c.x}), 0), i1 = square(std::max({a.x, b.x, c.x}), 0);
    const int j0 = square(std::min({a.y, b.y, c.y}), 1), j1 = square(std::max({a.y, b.y, c.y}), 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) crossAt(a, b, c, i, j);
  }
  void crossAt(const Vec3d& a, const Vec3d& b, const Vec3d& c, int i, int j) {
    const Vec2d p = place(i, j);
    const auto turn = [&](const Vec3d& u, const Vec3d& v) {
      return (u.x - p.x) * (v.y - p.y) - (u.y - p.y) * (v.x - p.x);
    };
    const double wa = turn(b, c), wb = turn(c, a), wc = turn(a, b), sum = wa + wb + wc;
    const bool inside = (wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0);
    if (!inside || sum == 0) return;
    lines_[j * side_ + i].crossings.push_back({(wa * a.z + wb * b.z + wc * c.z) / sum, sum < 0 ? 1 : -1});
  }
  void collect() {
    double sum = 0;
    for (int n = 0; n < side_ * side_; ++n) {
      auto& crossings = lines_[n].crossings;
      std::sort(crossings.begin(), crossings.end());
      int winding = 0;
      for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
        winding += crossings[k].second;
        if (winding <= 0) continue;
        sum += crossings[k + 1].first - crossings[k].first;
        ends_.push_back(sum);
        stretches_.push_back({place(n % side_, n / side_), crossings[k + 1].first});
      }
    }
  }

  int side_;
  const SolidSurface& surface_;
  Box3 box_;
  std::vector<Line> lines_;
  std::vector<double> ends_;                         ///< running sum of lengths
  std::vector<std::pair<Vec2d, double>> stretches_;  ///< place and upper end
};

}  // namespace

std::vector<Vec3d> solidSeeds(const SolidSurface& surface, const Voronoi& cells, int count, std::uint64_t seed) {
  constexpr int leastSide = 48, leastPlaces = 4096, placesPerSeed = 16;
  const int side = std::max(leastSide, static_cast<int>(std::sqrt(4.0 * count)));
  const Random random(seed, Stream::solidCells);
  const InsideLines lines(surface, side, random);
  if (!(lines.length() > 0)) throw InputError("solid: the mesh must enclose a volume");
  std::uint64_t draw = 2 * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
  std::vector<Vec3d> places;
  for (int n = 0; n < std::max(leastPlaces, placesPerSeed * count); ++n)
    places.push_back(lines.at(random.uniform(draw++) * lines.length()));
  std::vector<Vec3d> seeds;
  for (const std::uint32_t chosen : crowdedPoints(places, {}, count, cells, seed)) seeds.push_back(places[chosen]);
  return seeds;
}

}  // namespace brisance
