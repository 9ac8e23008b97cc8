#include "assets/even_remesh.h"

#include "assets/elastic_mesh.h"
#include "base/check.h"

namespace brisance::samples {
namespace {

using Edge = ElasticMesh::Edge;

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, const Implicit& solid, const EdgeSize& size)
      : mesh_(mesh), solid_(solid), size_(size) {}

  TriangleMesh run(std::size_t wanted) {
    double area = 0;
    for (const Edge& edge : mesh_.edges()) area += square(relativeLength(edge)) / (2 * std::sqrt(3.0));
    unit_ = std::sqrt(area / static_cast<double>(wanted) * 4 / std::sqrt(3.0));
    constexpr int rounds = 4, passes = 4, lastPasses = 12;
    for (int round = 0; round < rounds; ++round) {
      for (int pass = 0; pass < passes; ++pass) evenOut();
      unit_ *= std::sqrt(static_cast<double>(mesh_.triangleCount()) / static_cast<double>(wanted));
    }
    reachCount(wanted);
    for (int pass = 0; pass < lastPasses; ++pass) smooth();
    return mesh_.mesh();
  }

 private:
  static double square(double x) { return x * x; }
  Vec3d middleOf(const Edge& edge) const { return (mesh_.place(edge.a) + mesh_.place(edge.b)) / 2.0; }
  double relativeLength(const Edge& edge) const { return mesh_.lengthOf(edge) / size_(middleOf(edge)); }

  /// Splits above 4/3 of the wanted length, collapses below 4/5 (Botsch & Kobbelt 2004, section 4).
  void evenOut() {
    constexpr double longest = 4.0 / 3, shortest = 4.0 / 5;
    for (const Edge& edge : mesh_.edges())
      if (relativeLength(edge) > longest * unit_) mesh_.split(edge, ontoSurface(solid_, middleOf(edge)));
    for (const Edge& edge : mesh_.edges())
      if (mesh_.has(edge) && relativeLength(edge) < shortest * unit_ && !becomesLong(edge, longest))
        mesh_.collapse(edge, ontoSurface(solid_, middleOf(edge)));
    smooth();
  }

  bool becomesLong(const Edge& edge, double longest) const {
    const Vec3d middle = middleOf(edge);
    const double limit = longest * unit_ * size_(middle);
    for (const std::uint32_t end : {edge.a, edge.b})
      for (const std::uint32_t other : mesh_.neighbours(end))
        if (length(mesh_.place(other) - middle) > limit) return true;
    return false;
  }

  void smooth() {
    for (const Edge& edge : mesh_.edges())
      if (mesh_.has(edge)) mesh_.flip(edge);
    relax();
  }

  /// Each vertex goes to the middle of its neighbours, but along the surface.
  void relax() {
    std::vector<Vec3d> targets(mesh_.vertexCount());
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v) {
      const auto around = mesh_.neighbours(v);
      if (around.empty()) continue;
      Vec3d middle;
      for (const std::uint32_t other : around) middle += mesh_.place(other) / static_cast<double>(around.size());
      const Vec3d normal = mesh_.normalAt(v), step = middle - mesh_.place(v);
      targets[v] = ontoSurface(solid_, mesh_.place(v) + (step - normal * dot(step, normal)));
    }
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v)
      if (!mesh_.neighbours(v).empty()) mesh_.move(v, targets[v]);
  }

  /// Collapses the relatively shortest edge that may be collapsed, or splits the longest, again and again.
  void reachCount(std::size_t wanted) {
    while (mesh_.triangleCount() < wanted) {
      const Edge longest = edgesByLength().back();
      mesh_.split(longest, ontoSurface(solid_, middleOf(longest)));
    }
    while (mesh_.triangleCount() > wanted) {
      const std::vector<Edge> edges = edgesByLength();
      const bool done = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
        return mesh_.collapse(edge, ontoSurface(solid_, middleOf(edge)));
      });
      CHECK(done, "no edge collapses at {} triangles", mesh_.triangleCount());
    }
  }

  std::vector<Edge> edgesByLength() const {
    std::vector<std::pair<double, Edge>> byLength;
    for (const Edge& edge : mesh_.edges()) byLength.push_back({relativeLength(edge), edge});
    std::stable_sort(byLength.begin(), byLength.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    std::vector<Edge> edges;
    edges.reserve(byLength.size());
    for (const auto& [length, edge] : byLength) edges.push_back(edge);
    return edges;
  }

  ElasticMesh mesh_;
  const Implicit& solid_;
  const EdgeSize& size_;
  double unit_ = 0;  ///< [m] wanted length where the size is 1
};

}  // namespace

TriangleMesh evenRemesh(const TriangleMesh& mesh, const Implicit& solid, const EdgeSize& size, std::size_t triangles) {
  CHECK(triangles % 2 == 0, "a closed surface has an even number of triangles, not {}", triangles);
  return Remesher(mesh, solid, size).run(triangles);
}

double edgeUnevenness(const TriangleMesh& mesh, const EdgeSize& size) {
  double sum = 0, squares = 0, count = 0;
  for (const Triangle& t : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3d &a = mesh.vertices[t[corner]], &b = mesh.vertices[t[(corner + 1) % 3]];
      const double relative = length(a - b) / size((a + b) / 2.0);
      sum += relative;
      squares += relative * relative;
      ++count;
    }
  const double mean = sum / count;
  return std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean;
}

}  // namespace brisance::samples
