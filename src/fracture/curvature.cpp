#include "fracture/curvature.h"

#include <algorithm>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {
namespace {

constexpr double leastDeficit = 1e-4;  // [radians] flat glass has none at all
constexpr std::int64_t trianglesAtOnce = 4096, rowsAtOnce = 4096;

struct CornerAngles {
  std::array<double, 3> angle{};  ///< [radians]
  double area = 0;                ///< [m2]
};

CornerAngles cornerAngles(const TriangleMesh& mesh, const Triangle& t) {
  CornerAngles result;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3d& p = mesh.vertices[t[corner]];
    const Vec3d a = mesh.vertices[t[(corner + 1) % 3]] - p, b = mesh.vertices[t[(corner + 2) % 3]] - p;
    const double twiceArea = length(cross(a, b));
    result.angle[corner] = portableAtan2(twiceArea, dot(a, b));
    if (corner == 0) result.area = twiceArea / 2;
  }
  return result;
}

/// Neighbours of each vertex, once per triangle on the edge, rows sorted.
struct EdgeUses {
  std::vector<std::uint32_t> first, targets;
};

/// `node(v)` is the row of vertex v.
template <class NodeOf>
EdgeUses edgeUses(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, std::size_t nodes,
                  const NodeOf& node) {
  EdgeUses uses{std::vector<std::uint32_t>(nodes + 1, 0), {}};
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles[t]) uses.first[node(v) + 1] += 2;
  std::partial_sum(uses.first.begin(), uses.first.end(), uses.first.begin());
  uses.targets.resize(uses.first.back());
  std::vector<std::uint32_t> next(uses.first.begin(), uses.first.end() - 1);
  for (const std::uint32_t t : triangles) {
    const Triangle& corners = mesh.triangles[t];
    const std::uint32_t a = node(corners[0]), b = node(corners[1]), c = node(corners[2]);
    for (const auto& [from, left, right] : {std::array{a, b, c}, {b, c, a}, {c, a, b}}) {
      uses.targets[next[from]++] = left;
      uses.targets[next[from]++] = right;
    }
  }
  parallelFor(0, static_cast<std::int64_t>(nodes), rowsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      std::sort(uses.targets.begin() + uses.first[i], uses.targets.begin() + uses.first[i + 1]);
  });
  return uses;
}

std::vector<std::uint32_t> allOf(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

/// Whether a sorted row names some neighbour only once: an edge of one triangle.
bool atBorder(std::span<const std::uint32_t> row) {
  for (std::size_t i = 0; i < row.size();) {
    std::size_t end = i + 1;
    while (end < row.size() && row[end] == row[i]) ++end;
    if (end == i + 1) return true;
    i = end;
  }
  return false;
}

/// Between order statistics, linearly.
double percentile(std::vector<double>& values, double share) {
  const double rank = share * static_cast<double>(values.size() - 1);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), lower, values.end());
  if (lower + 1 == values.end()) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + (rank - std::floor(rank)) * (upper - *lower);
}

/// K of vertices that no triangle uses is 0 and does not count; where every triangle around is degenerate, the least of
/// the others holds.
void keepPositive(std::vector<double>& strength) {
  double least = HUGE_VAL;
  for (const double k : strength)
    if (k > 0) least = std::min(least, k);
  for (double& k : strength)
    if (!(k > 0)) k = std::isfinite(least) ? least : 1;
}

void clipToPercentiles(std::vector<double>& strength) {
  std::vector<double> used;
  std::copy_if(strength.begin(), strength.end(), std::back_inserter(used), [](double k) { return k > 0; });
  if (used.empty()) return;
  const double lower = percentile(used, 0.05), upper = percentile(used, 0.95);
  for (double& k : strength) k = std::clamp(k, lower, upper);
}

}  // namespace

std::vector<double> vertexStrength(const TriangleMesh& mesh, CurvatureWeights weights) {
  const std::size_t vertices = mesh.vertices.size();
  std::vector<CornerAngles> corners(mesh.triangles.size());
  parallelFor(0, static_cast<std::int64_t>(corners.size()), trianglesAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) corners[t] = cornerAngles(mesh, mesh.triangles[t]);
  });
  std::vector<double> angleSum(vertices, 0), area(vertices, 0);
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      angleSum[mesh.triangles[t][corner]] += corners[t].angle[corner];
      area[mesh.triangles[t][corner]] += corners[t].area;
    }
  const std::vector<std::uint32_t> all = allOf(mesh.triangles.size());
  const EdgeUses uses = edgeUses(mesh, all, vertices, [](std::uint32_t v) { return v; });
  std::vector<double> strength(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const bool border = atBorder({uses.targets.data() + uses.first[v], uses.first[v + 1] - uses.first[v]});
    const double deficit = (border ? pi : 2 * pi) - angleSum[v];
    strength[v] = area[v] / (3 * std::max(std::abs(deficit), leastDeficit));
  }
  if (weights == CurvatureWeights::clipped) clipToPercentiles(strength);
  keepPositive(strength);
  return strength;
}

VertexGraphs::VertexGraphs(const TriangleMesh& mesh, Rule rule)
    : mesh_(mesh), rule_(rule), nodeOf_(mesh.vertices.size()) {}

VertexGraphs::VertexGraphs(const TriangleMesh& mesh, const Curvature& curvature)
    : VertexGraphs(mesh, Rule::meanStrength) {
  strength_ = vertexStrength(mesh, curvature.weights);
}

VertexGraphs::VertexGraphs(const TriangleMesh& mesh, const Spectral& spectral)
    : VertexGraphs(mesh, spectral.weights == EdgeWeights::unit ? Rule::unit : Rule::length) {
  constexpr double shortest = 1e-6;  // of the size of the mesh
  const double size = length(bounds(mesh).size());
  leastLength_ = size > 0 ? shortest * size : 1;
}

double VertexGraphs::weight(std::uint32_t a, std::uint32_t b) const {
  switch (rule_) {
    case Rule::meanStrength:
      return (strength_[a] + strength_[b]) / 2;
    case Rule::length:
      return std::max(length(mesh_.vertices[a] - mesh_.vertices[b]), leastLength_);
    case Rule::unit:
      break;
  }
  return 1;
}

VertexGraph VertexGraphs::whole() { return of(allOf(mesh_.triangles.size())); }

VertexGraph VertexGraphs::of(std::span<const std::uint32_t> triangles) {
  constexpr std::uint32_t unused = 0xFFFFFFFFu;
  VertexGraph result;
  FractureGraph& graph = result.graph;
  std::vector<std::uint32_t>& vertexOf = result.vertexOf;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh_.triangles[t]) nodeOf_[v] = unused;
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh_.triangles[t])
      if (nodeOf_[v] == unused) {
        nodeOf_[v] = 0;
        vertexOf.push_back(v);
      }
  std::sort(vertexOf.begin(), vertexOf.end());
  for (std::uint32_t node = 0; node < vertexOf.size(); ++node) nodeOf_[vertexOf[node]] = node;
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = mesh_.triangles[t];
    result.triangles.push_back({nodeOf_[a], nodeOf_[b], nodeOf_[c]});
  }
  EdgeUses uses = edgeUses(mesh_, triangles, vertexOf.size(), [&](std::uint32_t v) { return nodeOf_[v]; });
  graph.first.reserve(vertexOf.size() + 1);
  graph.first.push_back(0);
  std::uint32_t end = 0;
  for (std::uint32_t node = 0; node < vertexOf.size(); ++node) {
    // Each edge once; a folded triangle's edge from a vertex to itself not at all.
    for (std::uint32_t k = uses.first[node]; k < uses.first[node + 1]; ++k) {
      const std::uint32_t target = uses.targets[k];
      if (target == node || (end > graph.first.back() && uses.targets[end - 1] == target)) continue;
      uses.targets[end++] = target;
    }
    graph.first.push_back(end);
    graph.places.push_back(mesh_.vertices[vertexOf[node]]);
  }
  graph.targets.assign(uses.targets.begin(), uses.targets.begin() + end);
  graph.weights.resize(end);
  parallelFor(0, graph.nodeCount(), rowsAtOnce, [&](std::int64_t begin, std::int64_t last) {
    for (auto node = static_cast<std::uint32_t>(begin); node < last; ++node)
      for (std::uint32_t k = graph.first[node]; k < graph.first[node + 1]; ++k)
        graph.weights[k] = weight(vertexOf[node], vertexOf[graph.targets[k]]);
  });
  return result;
}

VertexGraph vertexGraph(const TriangleMesh& mesh, const Curvature& curvature) {
  return VertexGraphs(mesh, curvature).whole();
}
VertexGraph vertexGraph(const TriangleMesh& mesh, const Spectral& spectral) {
  return VertexGraphs(mesh, spectral).whole();
}

}  // namespace brisance
