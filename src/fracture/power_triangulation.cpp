#include "fracture/power_triangulation.h"

#include "base/check.h"

namespace brisance {
namespace {

Int128 determinant(const Vec3l& a, const Vec3l& b, const Vec3l& c) {
  const Vec3<Int128> wideA(a), wideB(b), wideC(c);
  return dot(wideA, cross(wideB, wideC));
}

class Triangulator {
 public:
  explicit Triangulator(const std::vector<WeightedSeed>& seeds) : seeds_(seeds) {
    const auto count = static_cast<std::uint32_t>(seeds.size());
    CHECK(count >= 4, "{} seeds", count);
    Tetrahedron first{{count - 4, count - 3, count - 2, count - 1},
                      {noTetrahedron, noTetrahedron, noTetrahedron, noTetrahedron}};
    if (!isPositive(orientationOf(first))) std::swap(first.seeds[0], first.seeds[1]);
    tetrahedra_.push_back(first);
    alive_.push_back(true);
    for (std::uint32_t seed = 0; seed + 4 < count; ++seed) insert(seed);
  }

  /// Those alive, numbered anew.
  std::vector<Tetrahedron> result() const {
    std::vector<std::uint32_t> numberOf(tetrahedra_.size(), noTetrahedron);
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < tetrahedra_.size(); ++t)
      if (alive_[t]) numberOf[t] = count++;
    std::vector<Tetrahedron> result;
    result.reserve(count);
    for (std::uint32_t t = 0; t < tetrahedra_.size(); ++t) {
      if (!alive_[t]) continue;
      result.push_back(tetrahedra_[t]);
      for (std::uint32_t& next : result.back().neighbours)
        if (next != noTetrahedron) next = numberOf[next];
    }
    return result;
  }

 private:
  struct Side {
    std::uint32_t tetrahedron;
    int face;
  };
  struct OpenFace {
    std::uint32_t low, high;  ///< the edge that it shares with its twin, beside the new seed
    Side side;
  };

  const Vec3l& place(std::uint32_t seed) const { return seeds_[seed].place; }
  Int128 orientationOf(const Tetrahedron& t) const {
    return orientation(place(t.seeds[0]), place(t.seeds[1]), place(t.seeds[2]), place(t.seeds[3]));
  }

  /// Whether the seed lies below the plane through the tetrahedron's corners, lifted to the paraboloid.
  bool conflicts(const Tetrahedron& t, std::uint32_t seed) const {
    std::array<Vec3l, 4> corner;
    std::array<Int128, 4> height;
    for (int c = 0; c < 4; ++c) {
      corner[c] = place(t.seeds[c]) - place(seed);
      height[c] = dot(corner[c], corner[c]) - seeds_[t.seeds[c]].weight + seeds_[seed].weight;
    }
    const auto& [a, b, c, d] = corner;
    const Int128 sum = height[0] * determinant(b, c, d) - height[1] * determinant(a, c, d) +
                       height[2] * determinant(a, b, d) - height[3] * determinant(a, b, c);
    return isPositive(sum);
  }

  /// Walks towards the seed through faces that have it on their other side.
  std::uint32_t locate(std::uint32_t seed) const {
    std::uint32_t t = static_cast<std::uint32_t>(tetrahedra_.size() - 1);
    for (bool moved = true; moved;) {
      moved = false;
      for (int face = 0; face < 4 && !moved; ++face) {
        Tetrahedron beyond = tetrahedra_[t];
        beyond.seeds[face] = seed;
        if (orientationOf(beyond) >= 0) continue;
        t = tetrahedra_[t].neighbours[face];
        CHECK(t != noTetrahedron, "seed {} lies outside", seed);
        moved = true;
      }
    }
    return t;
  }

  void insert(std::uint32_t seed) {
    const std::uint32_t start = locate(seed);
    if (!conflicts(tetrahedra_[start], seed)) return;  // hidden
    cavity_.assign(1, start);
    border_.clear();
    alive_[start] = false;
    for (std::size_t next = 0; next < cavity_.size(); ++next)
      for (int face = 0; face < 4; ++face) {
        const std::uint32_t other = tetrahedra_[cavity_[next]].neighbours[face];
        if (other != noTetrahedron && !alive_[other])
          continue;  // in the cavity: the dead of earlier seeds touch nobody
        if (other != noTetrahedron && conflicts(tetrahedra_[other], seed)) {
          alive_[other] = false;
          cavity_.push_back(other);
        } else {
          border_.push_back({cavity_[next], face});
        }
      }
    fill(seed);
  }

  /// One tetrahedron from the seed to each face around the cavity.
  void fill(std::uint32_t seed) {
    open_.clear();
    for (const Side& side : border_) {
      Tetrahedron t = tetrahedra_[side.tetrahedron];
      t.seeds[side.face] = seed;
      if (!isPositive(orientationOf(t))) checkFailed("star-shaped cavity", __FILE__, __LINE__, "");
      const auto number = static_cast<std::uint32_t>(tetrahedra_.size());
      const std::uint32_t outside = t.neighbours[side.face];
      if (outside != noTetrahedron)
        *std::find(tetrahedra_[outside].neighbours.begin(), tetrahedra_[outside].neighbours.end(), side.tetrahedron) =
            number;
      for (int face = 0; face < 4; ++face)
        if (face != side.face) open_.push_back(openFace(t, number, face, side.face));
      tetrahedra_.push_back(t);
      alive_.push_back(true);
    }
    joinTwins();
  }

  static OpenFace openFace(const Tetrahedron& t, std::uint32_t number, int face, int apex) {
    std::uint32_t edge[2];
    int n = 0;
    for (int corner = 0; corner < 4; ++corner)
      if (corner != face && corner != apex) edge[n++] = t.seeds[corner];
    return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1]), {number, face}};
  }

  void joinTwins() {
    std::sort(open_.begin(), open_.end(), [](const OpenFace& a, const OpenFace& b) {
      return a.low != b.low     ? a.low < b.low
             : a.high != b.high ? a.high < b.high
                                : a.side.tetrahedron < b.side.tetrahedron;
    });
    for (std::size_t i = 0; i + 1 < open_.size(); i += 2) {
      const Side &a = open_[i].side, &b = open_[i + 1].side;
      CHECK(open_[i].low == open_[i + 1].low && open_[i].high == open_[i + 1].high, "a face without twin");
      tetrahedra_[a.tetrahedron].neighbours[a.face] = b.tetrahedron;
      tetrahedra_[b.tetrahedron].neighbours[b.face] = a.tetrahedron;
    }
  }

  const std::vector<WeightedSeed>& seeds_;
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<bool> alive_;
  std::vector<std::uint32_t> cavity_;
  std::vector<Side> border_;
  std::vector<OpenFace> open_;
};

}  // namespace

Int128 orientation(const Vec3l& a, const Vec3l& b, const Vec3l& c, const Vec3l& d) {
  return determinant(b - a, c - a, d - a);
}

std::vector<Tetrahedron> powerTriangulation(const std::vector<WeightedSeed>& seeds) {
  return Triangulator(seeds).result();
}

}  // namespace brisance
