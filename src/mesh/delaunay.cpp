#include <boost/polygon/voronoi.hpp>

#include "base/check.h"
#include "mesh/triangle_net.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

using VoronoiDiagram = boost::polygon::voronoi_diagram<double>;
using Polygon = std::vector<std::uint32_t>;

void buildDiagram(const LatticePoints& points, VoronoiDiagram& diagram) {
  boost::polygon::voronoi_builder<std::int32_t> builder;
  for (const std::uint32_t point : points.distinct) builder.insert_point(points.nodes[point].x, points.nodes[point].y);
  builder.construct(&diagram);
}

/// The sites around a Voronoi vertex, counter-clockwise, from the lowest number: the same polygon for any walk.
Polygon sitesAround(const VoronoiDiagram::vertex_type& vertex, const LatticePoints& points) {
  Polygon sites;
  const auto* edge = vertex.incident_edge();
  do {
    sites.push_back(points.distinct[edge->cell()->source_index()]);
    edge = edge->rot_next();
  } while (edge != vertex.incident_edge());
  std::rotate(sites.begin(), std::min_element(sites.begin(), sites.end()), sites.end());
  return sites;
}

bool isEar(const Polygon& polygon, std::size_t middle, const std::vector<LatticePoint>& nodes) {
  const std::size_t n = polygon.size();
  const std::size_t before = (middle + n - 1) % n, after = (middle + 1) % n;
  const LatticePoint a = nodes[polygon[before]], b = nodes[polygon[middle]], c = nodes[polygon[after]];
  if (orientation(a, b, c) <= 0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == before || i == middle || i == after) continue;
    const LatticePoint p = nodes[polygon[i]];
    if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0) return false;
  }
  return true;
}

/// Cuts ears off. The diagram merges vertices that agree to the last few bits, so a polygon of more than three sites is
/// nearly, not always exactly, on a circle, and may be bent inwards by a lattice step.
void cutIntoTriangles(Polygon polygon, const std::vector<LatticePoint>& nodes, std::vector<Triangle>& triangles) {
  while (polygon.size() >= 3) {
    std::size_t ear = 1;
    while (ear <= polygon.size() && !isEar(polygon, ear % polygon.size(), nodes)) ++ear;
    CHECK(ear <= polygon.size(), "a Voronoi vertex of {} sites has no ear", polygon.size());
    const std::size_t n = polygon.size(), middle = ear % n;
    triangles.push_back({polygon[(middle + n - 1) % n], polygon[middle], polygon[(middle + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(middle));
  }
}

/// Flips edges until no circle holds the point across (Lawson 1977). The dual is Delaunay but for merged vertices, so
/// few flips are left to do.
void flipToDelaunay(TriangleNet& net, const std::vector<LatticePoint>& nodes) {
  std::vector<std::uint32_t> open(net.triangles().size());
  for (std::uint32_t t = 0; t < open.size(); ++t) open[t] = static_cast<std::uint32_t>(open.size()) - 1 - t;
  while (!open.empty()) {
    const std::uint32_t triangle = open.back();
    open.pop_back();
    for (int edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = net.neighbours()[triangle][edge];
      if (other == noTriangle) continue;
      const Triangle t = net.triangles()[triangle];
      const std::uint32_t opposite = net.triangles()[other][(net.edgeTo(other, triangle) + 2) % 3];
      if (!insideCircle(nodes[t[0]], nodes[t[1]], nodes[t[2]], nodes[opposite])) continue;
      net.flip(triangle, edge);
      open.push_back(triangle);
      open.push_back(other);
      break;
    }
  }
}

}  // namespace

std::vector<Triangle> delaunay(const LatticePoints& points) {
  VoronoiDiagram diagram;
  buildDiagram(points, diagram);
  std::vector<Triangle> triangles;
  for (const auto& vertex : diagram.vertices()) cutIntoTriangles(sitesAround(vertex, points), points.nodes, triangles);
  TriangleNet net(std::move(triangles), points.nodes.size());
  flipToDelaunay(net, points.nodes);
  return net.triangles();
}

}  // namespace brisance
