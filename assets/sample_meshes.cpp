#include "assets/sample_meshes.h"

#include <map>
#include <unordered_map>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "grid/grid3.h"

namespace brisance::samples {
namespace {

/// A number from -1 to 1 that belongs to a lattice point.
double latticeValue(int i, int j, int k) {
  static const Random random(1, Stream::test);
  constexpr std::uint64_t row = 1u << 20;
  const auto part = [](int n) { return static_cast<std::uint64_t>(n + (1 << 19)); };
  return 2 * random.uniform((part(i) * row + part(j)) * row + part(k)) - 1;
}

double smoothNoise(const Vec3d& p) {
  const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const auto ease = [](double t) { return t * t * (3 - 2 * t); };
  const Vec3d t{ease(p.x - cell.x), ease(p.y - cell.y), ease(p.z - cell.z)};
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    sum += (a ? t.x : 1 - t.x) * (b ? t.y : 1 - t.y) * (c ? t.z : 1 - t.z) *
           latticeValue(static_cast<int>(cell.x) + a, static_cast<int>(cell.y) + b, static_cast<int>(cell.z) + c);
  }
  return sum;
}

constexpr std::uint32_t noVertex = 0xFFFFFFFFu;

/// Values at lattice points, and the vertex of each cell.
class Net {
 public:
  Net(const Implicit& body, const Box3& box, double step) : step_(step), corner_(box.lower) {
    const Vec3d cells = box.size() / step;
    size_ = {static_cast<int>(std::ceil(cells.x)) + 2, static_cast<int>(std::ceil(cells.y)) + 2,
             static_cast<int>(std::ceil(cells.z)) + 2};
    values_.resize(static_cast<std::size_t>(size_.x) * size_.y * size_.z);
    parallelFor(0, size_.z, 1, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k)
        for (int j = 0; j < size_.y; ++j)
          for (int i = 0; i < size_.x; ++i) values_[at(i, j, k)] = static_cast<float>(body(point(i, j, k)));
    });
  }

  TriangleMesh mesh() {
    placeVertices();
    for (int k = 1; k + 1 < size_.z; ++k)
      for (int j = 1; j + 1 < size_.y; ++j)
        for (int i = 1; i + 1 < size_.x; ++i)
          for (int axis = 0; axis < 3; ++axis) addQuad({i, j, k}, axis);
    return std::move(mesh_);
  }

 private:
  std::size_t at(int i, int j, int k) const { return (static_cast<std::size_t>(k) * size_.y + j) * size_.x + i; }
  Vec3d point(int i, int j, int k) const { return corner_ + Vec3d(i, j, k) * step_; }

  void placeVertices() {
    vertexOf_.assign(values_.size(), noVertex);
    for (int k = 0; k + 1 < size_.z; ++k)
      for (int j = 0; j + 1 < size_.y; ++j)
        for (int i = 0; i + 1 < size_.x; ++i) placeVertex(i, j, k);
  }

  /// The mean of the points where the surface crosses the cell's edges.
  void placeVertex(int i, int j, int k) {
    Vec3d sum;
    int crossings = 0;
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        if (corner >> axis & 1) continue;
        const int end = corner | 1 << axis;
        const double a = values_[at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2))];
        const double b = values_[at(i + (end & 1), j + (end >> 1 & 1), k + (end >> 2))];
        if ((a < 0) == (b < 0)) continue;
        Vec3d place(corner & 1, corner >> 1 & 1, corner >> 2);
        place[axis] += a / (a - b);
        sum += place;
        ++crossings;
      }
    if (crossings == 0) return;
    vertexOf_[at(i, j, k)] = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(point(i, j, k) + sum * (step_ / crossings));
  }

  /// The four cells around a lattice edge from (i, j, k) along an axis, where the surface crosses it.
  void addQuad(const Vec3i& p, int axis) {
    Vec3i end = p;
    ++end[axis];
    const bool inside = values_[at(p.x, p.y, p.z)] < 0;
    if (inside == (values_[at(end.x, end.y, end.z)] < 0)) return;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corners{};
    for (int n = 0; n < 4; ++n) {
      Vec3i cell = p;
      if (n == 0 || n == 3) --cell[u];
      if (n < 2) --cell[v];
      corners[n] = vertexOf_[at(cell.x, cell.y, cell.z)];
      CHECK(corners[n] != noVertex, "the body touches the box near {} {} {}", p.x, p.y, p.z);
    }
    const auto [a, b, c, d] = corners;
    if (inside) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({a, c, b});
      mesh_.triangles.push_back({a, d, c});
    }
  }

  double step_;
  Vec3d corner_;
  Vec3i size_;
  std::vector<float> values_;
  std::vector<std::uint32_t> vertexOf_;
  TriangleMesh mesh_;
};

/// The faces of an icosahedron about the origin.
struct Icosahedron {
  std::array<Vec3d, 12> vertices;
  std::array<Triangle, 20> triangles;
};

Icosahedron icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Icosahedron result;
  int n = 0;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) {
      result.vertices[n++] = {0, a, b};
      result.vertices[n++] = {a, b, 0};
      result.vertices[n++] = {b, 0, a};
    }
  n = 0;
  const auto close = [&](std::uint32_t a, std::uint32_t b) {
    return length(result.vertices[a] - result.vertices[b]) < 2.1;
  };
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!close(a, b) || !close(b, c) || !close(a, c)) continue;
        const auto& v = result.vertices;
        const bool outward = dot(cross(v[b] - v[a], v[c] - v[a]), v[a]) > 0;
        result.triangles[n++] = outward ? Triangle{a, b, c} : Triangle{a, c, b};
      }
  CHECK(n == 20, "{} faces", n);
  return result;
}

/// Each face of the icosahedron in n^2 triangles; points on shared edges are shared.
class Geodesic {
 public:
  explicit Geodesic(int n) : n_(n) {}
  TriangleMesh mesh() {
    for (const Triangle& face : base_.triangles)
      for (int i = 0; i < n_; ++i)
        for (int j = 0; j < n_ - i; ++j) {
          const std::uint32_t b = vertex(face, i + 1, j), c = vertex(face, i, j + 1);
          mesh_.triangles.push_back({vertex(face, i, j), b, c});
          if (i + j < n_ - 1) mesh_.triangles.push_back({b, vertex(face, i + 1, j + 1), c});
        }
    return std::move(mesh_);
  }

 private:
  /// The point at i steps towards the face's second corner and j towards its third.
  std::uint32_t vertex(const Triangle& face, int i, int j) {
    std::array<std::pair<int, int>, 3> shares{std::pair(static_cast<int>(face[0]), n_ - i - j),
                                              {static_cast<int>(face[1]), i},
                                              {static_cast<int>(face[2]), j}};
    for (auto& [corner, share] : shares)
      if (share == 0) corner = -1;
    std::sort(shares.begin(), shares.end());
    const auto [place, isNew] = numberOf_.try_emplace(shares, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (!isNew) return place->second;
    Vec3d sum;
    for (const auto& [corner, share] : shares)
      if (corner >= 0) sum += base_.vertices[corner] * static_cast<double>(share);
    mesh_.vertices.push_back(normalized(sum));
    return place->second;
  }

  int n_;
  Icosahedron base_ = icosahedron();
  std::map<std::array<std::pair<int, int>, 3>, std::uint32_t> numberOf_;
  TriangleMesh mesh_;
};

}  // namespace

double noise(const Vec3d& p) {
  double sum = 0, frequency = 1;
  for (int octave = 0; octave < 4; ++octave, frequency *= 2) sum += smoothNoise(p * frequency) / frequency;
  return sum;
}

TriangleMesh surfaceNet(const Implicit& body, const Box3& box, double step) { return Net(body, box, step).mesh(); }

TriangleMesh surfaceNetOf(const Implicit& body, const Box3& box, long triangles) {
  // The number of triangles grows as 1 / step^2: two trials on coarse lattices, then the real one.
  const Vec3d size = box.size();
  double step = std::max({size.x, size.y, size.z}) / 40;
  for (int trial = 0; trial < 2; ++trial) {
    const double count = static_cast<double>(surfaceNet(body, box, step).triangles.size());
    step *= std::sqrt(count / static_cast<double>(triangles));
  }
  return surfaceNet(body, box, step);
}

TriangleMesh bumpySphere(long triangles) {
  TriangleMesh mesh = Geodesic(static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 20)))).mesh();
  for (Vec3d& v : mesh.vertices) v *= 1 + 0.06 * noise(v * 4.0 + Vec3d(7, 0, 0));
  return mesh;
}

TriangleMesh dumbbell(long triangles) {
  const Implicit body = [](const Vec3d& p) {
    const double left = length(p - Vec3d(-1.2, 0, 0)) - 1, right = length(p - Vec3d(1.2, 0, 0)) - 0.8;
    const double neck = length(p - Vec3d(std::clamp(p.x, -1.2, 1.2), 0, 0)) - 0.18;
    return smoothUnion(smoothUnion(left, neck, 0.15), right, 0.15) + 0.03 * noise(p * 3.0);
  };
  return surfaceNetOf(body, {{-2.5, -1.35, -1.35}, {2.3, 1.35, 1.35}}, triangles);
}

TriangleMesh figurine(long triangles) {
  struct Limb {
    Vec3d from, to;
    double radius;
  };
  static const Limb limbs[] = {
      {{0, 0.85, 0}, {0, 1.25, 0}, 0.36},                                                        // trunk
      {{0.2, 0.2, 0}, {0.17, 0.75, 0}, 0.17},     {{-0.2, 0.2, 0}, {-0.17, 0.75, 0}, 0.17},      // legs
      {{0.2, 0.13, 0}, {0.22, 0.12, 0.16}, 0.13}, {{-0.2, 0.13, 0}, {-0.22, 0.12, 0.16}, 0.13},  // feet
      {{0.3, 1.4, 0}, {0.78, 1.15, 0.12}, 0.12},  {{-0.3, 1.4, 0}, {-0.72, 1.7, 0.1}, 0.12},     // arms
      {{0, 1.5, 0}, {0, 1.6, 0}, 0.15},                                                          // neck
      {{0, 1.93, 0.02}, {0, 1.97, 0.02}, 0.31},                                                  // head
      {{0.22, 2.17, 0}, {0.24, 2.2, 0}, 0.1},     {{-0.22, 2.17, 0}, {-0.24, 2.2, 0}, 0.1},      // ears
      {{0, 1.88, 0.3}, {0, 1.9, 0.33}, 0.09}};                                                   // nose
  const Implicit body = [](const Vec3d& p) {
    double distance = 1e9;
    for (const Limb& limb : limbs) {
      const Vec3d axis = limb.to - limb.from;
      const double share = std::clamp(dot(p - limb.from, axis) / dot(axis, axis), 0.0, 1.0);
      constexpr double rounding = 0.09;
      distance = smoothUnion(distance, length(p - limb.from - axis * share) - limb.radius, rounding);
    }
    return distance;
  };
  return surfaceNetOf(body, {{-1.0, -0.15, -0.55}, {1.0, 2.45, 0.55}}, triangles);
}

TriangleMesh torus(long triangles) {
  // 2 n m triangles with cells about square: m around the tube, n along the ring.
  constexpr double ring = 1, tube = 0.4;
  const int m =
      std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) * tube / (2 * ring)))));
  const int n = std::max(3, static_cast<int>(std::lround(static_cast<double>(triangles) / (2.0 * m))));
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const auto [sinRing, cosRing] = portableSinCos(2 * pi * i / n);
      const auto [sinTube, cosTube] = portableSinCos(2 * pi * j / m);
      const double r = ring + tube * cosTube;
      mesh.vertices.push_back({r * cosRing, r * sinRing, tube * sinTube});
    }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

TriangleMesh foldedSheet(int cells, double degrees, double foldAt) {
  // Arc length s along the sheet from the fold; the direction turns by `degrees` in all, along a smooth step.
  constexpr double length = 2, foldWidth = 0.2;
  TriangleMesh mesh;
  const int along = 2 * cells;
  const double step = length / along, turn = degrees * pi / 180;
  Vec3d place;
  for (int i = 0; i <= along; ++i) {
    const double s = -foldAt * length + i * step;
    const double t = std::clamp(s / foldWidth + 0.5, 0.0, 1.0);
    const auto [sine, cosine] = portableSinCos(turn * (t * t * (3 - 2 * t) - 0.5));
    if (i > 0) place += Vec3d(cosine, 0, sine) * step;
    for (int j = 0; j <= cells; ++j) {
      // A slight saddle across makes the fold doubly curved: a surface that is bent one way only has no Gaussian
      // curvature at all.
      const double y = static_cast<double>(j) / cells - 0.5;
      const double bulge = 4 * t * (1 - t);
      mesh.vertices.push_back(place + Vec3d(0, y, -0.3 * y * y * bulge));
    }
  }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  const Vec3d fold = mesh.vertices[vertex(static_cast<int>(std::lround(foldAt * along)), cells / 2)];
  recenter(mesh, {fold.x, 0, 0});
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < cells; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

}  // namespace brisance::samples
