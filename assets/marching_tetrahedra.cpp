#include "assets/marching_tetrahedra.h"

#include <unordered_map>

#include "base/parallel.h"

namespace brisance::samples {
namespace {

class Lattice {
 public:
  Lattice(const Implicit& solid, const Box3& box, double step) : corner_(box.lower), step_(step) {
    const Vec3d cells = box.size() / step;
    for (int axis = 0; axis < 3; ++axis) points_[axis] = static_cast<int>(std::ceil(cells[axis])) + 1;
    values_.resize(static_cast<std::size_t>(points_.x) * points_.y * points_.z);
    parallelFor(0, points_.z, 1, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k)
        for (int j = 0; j < points_.y; ++j)
          for (int i = 0; i < points_.x; ++i) values_[number({i, j, k})] = solid(place(number({i, j, k})));
    });
  }

  TriangleMesh surface() {
    for (int k = 0; k + 1 < points_.z; ++k)
      for (int j = 0; j + 1 < points_.y; ++j)
        for (int i = 0; i + 1 < points_.x; ++i) addCell({i, j, k});
    return std::move(mesh_);
  }

 private:
  using Tetrahedron = std::array<std::size_t, 4>;  ///< numbers of lattice points, right-handed

  std::size_t number(const Vec3i& p) const {
    return (static_cast<std::size_t>(p.z) * points_.y + p.y) * points_.x + p.x;
  }
  Vec3d place(std::size_t point) const {
    const std::size_t row = point / points_.x;
    return corner_ + Vec3d(static_cast<double>(point % points_.x), static_cast<double>(row % points_.y),
                           static_cast<double>(row / points_.y)) *
                         step_;
  }
  bool isInside(std::size_t point) const { return values_[point] < 0; }

  /// From the cell's corner to the opposite one by each order of the axes.
  void addCell(const Vec3i& cell) {
    static constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int n = 0; n < 6; ++n) {
      Vec3i p = cell;
      Tetrahedron points{number(p)};
      for (int step = 0; step < 3; ++step) {
        ++p[orders[n][step]];
        points[step + 1] = number(p);
      }
      constexpr int rightHanded = 3;  // the first three orders are even
      if (n >= rightHanded) std::swap(points[2], points[3]);
      addTetrahedron(points);
    }
  }

  void addTetrahedron(Tetrahedron points) {
    const auto inside = std::count_if(points.begin(), points.end(), [&](std::size_t p) { return isInside(p); });
    if (inside == 0 || inside == 4) return;
    bringForward(points, inside == 3 ? false : true);
    const auto [a, b, c, d] = points;
    if (inside == 1) addTriangle(vertexOn(a, b), vertexOn(a, c), vertexOn(a, d));
    if (inside == 3) addTriangle(vertexOn(a, b), vertexOn(a, d), vertexOn(a, c));
    if (inside != 2) return;
    const std::uint32_t ac = vertexOn(a, c), bc = vertexOn(b, c), bd = vertexOn(b, d), ad = vertexOn(a, d);
    addTriangle(ac, ad, bd);
    addTriangle(ac, bd, bc);
  }

  /// Even exchanges of corners, until those that are inside (or outside) come first.
  void bringForward(Tetrahedron& points, bool side) const {
    static constexpr int evenOrders[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2},
                                              {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 0, 1, 3}, {2, 1, 3, 0},
                                              {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 1, 0, 2}, {3, 2, 1, 0}};
    for (const auto& order : evenOrders) {
      const Tetrahedron turned{points[order[0]], points[order[1]], points[order[2]], points[order[3]]};
      const auto matches = [&](std::size_t p) { return isInside(p) == side; };
      if (!std::is_partitioned(turned.begin(), turned.end(), matches)) continue;
      points = turned;
      return;
    }
  }

  /// Where the surface crosses the edge between two points, a little away from both.
  std::uint32_t vertexOn(std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    const auto [entry, isNew] =
        vertexOf_.try_emplace(a * values_.size() + b, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (isNew) {
      constexpr double margin = 0.05;
      const double share = std::clamp(values_[a] / (values_[a] - values_[b]), margin, 1 - margin);
      mesh_.vertices.push_back(place(a) + (place(b) - place(a)) * share);
    }
    return entry->second;
  }

  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.push_back({a, b, c}); }

  Vec3d corner_;
  double step_;
  Vec3i points_;
  std::vector<double> values_;
  std::unordered_map<std::size_t, std::uint32_t> vertexOf_;  ///< by the edge's ends
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh marchingTetrahedra(const Implicit& solid, const Box3& box, double step) {
  return Lattice(solid, box, step).surface();
}

}  // namespace brisance::samples
