#include "mesh/voronoi_diagram.h"

#include <limits>

#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

double dot(const Vec2d& a, const Vec2d& b) { return a.x * b.x + a.y * b.y; }
Vec2d quarterTurn(const Vec2d& v) { return {-v.y, v.x}; }

/// How much farther from `a` than from `b`, in squares; the same with another sign from the other side, bit for bit.
double fartherFrom(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
  const Vec2d sum = a + b;
  return 2 * dot(p - sum * 0.5, b - a);
}

/// The part of a polygon that is nearer to `a` than to `b` (Sutherland & Hodgman 1974).
std::vector<Vec2d> nearerPart(const std::vector<Vec2d>& polygon, const Vec2d& a, const Vec2d& b) {
  std::vector<Vec2d> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double atP = fartherFrom(a, b, p), atQ = fartherFrom(a, b, q);
    if (atP <= 0) part.push_back(p);
    if ((atP < 0 && atQ > 0) || (atP > 0 && atQ < 0)) part.push_back(p + (q - p) * (atP / (atP - atQ)));
  }
  return part;
}

/// A stretch of a line, by the distance along its direction.
struct Stretch {
  double from, to;
};

/// Where a line runs inside a polygon.
std::vector<Stretch> insideStretches(const std::vector<Vec2d>& polygon, const Vec2d& start, const Vec2d& direction) {
  std::vector<double> hits;
  const Vec2d across = quarterTurn(direction);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d p = polygon[i] - start, q = polygon[(i + 1) % polygon.size()] - start;
    const double atP = dot(p, across), atQ = dot(q, across);
    if ((atP > 0) == (atQ > 0)) continue;
    hits.push_back(dot(p + (q - p) * (atP / (atP - atQ)), direction) / dot(direction, direction));
  }
  std::sort(hits.begin(), hits.end());
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i + 1 < hits.size(); i += 2) stretches.push_back({hits[i], hits[i + 1]});
  return stretches;
}

/// The bisector of an edge a-b leaves the nearest points of both where a third site is as near.
double endAt(const Vec2d& a, const Vec2d& b, const Vec2d& third) {
  const Vec2d toB = b - a, toThird = third - a;
  return dot(toThird, toThird - toB) / (2 * dot(quarterTurn(toB), toThird));
}

/// The dual of edge `e` of triangle `t`, which has the neighbour's third site to its right.
void addEdge(VoronoiDiagram& diagram, const FlatMesh& mesh, const std::vector<Vec2d>& outline, const Triangle& t, int e,
             const Triangle* neighbour) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const std::uint32_t a = t[e], b = t[(e + 1) % 3];
  const Vec2d &placeA = mesh.points[a], &placeB = mesh.points[b];
  double first = -endless;
  if (neighbour != nullptr)
    for (const std::uint32_t other : *neighbour)
      if (other != a && other != b) first = endAt(placeA, placeB, mesh.points[other]);
  const double last = endAt(placeA, placeB, mesh.points[t[(e + 2) % 3]]);
  const Vec2d middle = (placeA + placeB) * 0.5, direction = quarterTurn(placeB - placeA);
  for (const Stretch& stretch : insideStretches(outline, middle, direction)) {
    const double from = std::max(first, stretch.from), to = std::min(last, stretch.to);
    if (from < to) diagram.edges.push_back({a, b, middle + direction * from, middle + direction * to});
  }
}

}  // namespace

VoronoiDiagram voronoiDiagram(const std::vector<Vec2d>& sites, const std::vector<Vec2d>& outline) {
  const FlatMesh mesh = triangulate(sites, Delaunay{}, 0);
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
  VoronoiDiagram diagram{mesh.points, std::vector<std::vector<Vec2d>>(mesh.points.size()), {}};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t site : t) diagram.cells[site] = outline;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t other = neighbours[t][e], a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
      if (other != noTriangle && other < t) continue;
      addEdge(diagram, mesh, outline, mesh.triangles[t], e, other == noTriangle ? nullptr : &mesh.triangles[other]);
      diagram.cells[a] = nearerPart(diagram.cells[a], mesh.points[a], mesh.points[b]);
      diagram.cells[b] = nearerPart(diagram.cells[b], mesh.points[b], mesh.points[a]);
    }
  return diagram;
}

}  // namespace brisance
