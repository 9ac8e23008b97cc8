#include "fracture/cell_edges.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "base/check.h"

namespace brisance {
namespace {

using Int512 = boost::multiprecision::int512_t;

Int512 wide(Int128 value) {
  const bool negative = value < 0;
  __extension__ using Uint128 = unsigned __int128;
  const Uint128 magnitude = negative ? -static_cast<Uint128>(value) : static_cast<Uint128>(value);
  Int512 result = static_cast<std::uint64_t>(magnitude >> 64);
  result <<= 64;
  result += static_cast<std::uint64_t>(magnitude);
  return negative ? -result : result;
}

/// Faces of tetrahedra without ghosts, from both sides.
std::vector<CellEdge> findEdges(const CellDiagram& diagram, std::vector<std::array<std::uint32_t, 4>>& edgeOf) {
  struct Face {
    std::array<std::uint32_t, 3> cells;
    std::uint32_t tetrahedron;
    int face;
  };
  std::vector<Face> faces;
  const auto& tetrahedra = diagram.tetrahedra();
  edgeOf.assign(tetrahedra.size(), {CellEdges::noEdge, CellEdges::noEdge, CellEdges::noEdge, CellEdges::noEdge});
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t)
    for (int face = 0; face < 4; ++face) {
      const auto& s = tetrahedra[t].seeds;
      std::array<std::uint32_t, 3> cells{s[(face + 1) % 4], s[(face + 2) % 4], s[(face + 3) % 4]};
      std::sort(cells.begin(), cells.end());
      if (!diagram.isGhost(cells[2])) faces.push_back({cells, t, face});
    }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.cells != b.cells ? a.cells < b.cells : a.tetrahedron < b.tetrahedron;
  });
  std::vector<CellEdge> edges;
  for (std::size_t n = 0; n < faces.size(); n += 2) {
    CHECK(n + 1 < faces.size() && faces[n].cells == faces[n + 1].cells, "a face of one tetrahedron");
    const Face &face = faces[n], &twin = faces[n + 1];
    const auto place = [&](std::uint32_t seed) { return diagram.seeds()[seed].place; };
    const std::uint32_t opposite = tetrahedra[face.tetrahedron].seeds[face.face];
    const auto& [a, b, c] = face.cells;
    const bool beyond = isPositive(orientation(place(a), place(b), place(c), place(opposite)));
    for (const Face& side : {face, twin})
      edgeOf[side.tetrahedron][side.face] = static_cast<std::uint32_t>(edges.size());
    edges.push_back(
        {face.cells, beyond ? twin.tetrahedron : face.tetrahedron, beyond ? face.tetrahedron : twin.tetrahedron});
  }
  return edges;
}

/// A crossing's place along its edge as a fraction of whole numbers.
struct Place {
  Vec3<Int128> share;   ///< of the triangle's corners
  Int128 total;         ///< their sum, above 0
  Vec3<Int128> height;  ///< of the corners along the edge
  double value;
};

Int512 exactHeight(const Place& place) {
  Int512 sum = 0;
  for (int corner = 0; corner < 3; ++corner) sum += wide(place.share[corner]) * wide(place.height[corner]);
  return sum;
}

class EdgeOrder {
 public:
  EdgeOrder(const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram)
      : cut_(cut), surface_(surface), diagram_(diagram) {}

  /// Crossings of one edge from first to last.
  void add(CellEdge& edge, const std::vector<std::uint32_t>& points, std::vector<EdgeCrossing>& crossings) const {
    std::vector<std::pair<Place, EdgeCrossing>> places;
    places.reserve(points.size());
    for (const std::uint32_t point : points) places.push_back(placed(edge, point));
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return before(a, b); });
    edge.first = static_cast<std::uint32_t>(crossings.size());
    edge.count = static_cast<std::uint32_t>(points.size());
    for (const auto& [place, crossing] : places) crossings.push_back(crossing);
  }

 private:
  std::pair<Place, EdgeCrossing> placed(const CellEdge& edge, std::uint32_t point) const {
    const auto& [a, b, c] = edge.cells;
    const auto seed = [&](std::uint32_t cell) { return diagram_.seeds()[cell].place; };
    const Vec3<Int128> along(cross(seed(b) - seed(a), seed(c) - seed(a)));
    const Triangle& corners = surface_.triangles[cut_.points[point].of[0]];
    Vec3l rowB, rowC;
    Place place;
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3l& vertex = cut_.lattice[corners[corner]];
      const std::int64_t here = diagram_.power(a, vertex);
      rowB[corner] = here - diagram_.power(b, vertex);
      rowC[corner] = here - diagram_.power(c, vertex);
      place.height[corner] = dot(along, Vec3<Int128>(vertex));
    }
    place.share = meeting(rowB, rowC);
    place.total = place.share.x + place.share.y + place.share.z;
    // The sum of the shares is the edge's direction times the triangle's normal: above zero where it leaves the body.
    const bool leaves = isPositive(place.total);
    if (!leaves) {
      place.share = -place.share;
      place.total = -place.total;
    }
    const Vec3d share(place.share), height(place.height);
    place.value = dot(share, height) / static_cast<double>(place.total);
    return {place, {point, leaves ? -1 : 1}};
  }

  /// Exact where rounding could decide. Of crossings at one place the leaving first, so that bodies that touch do not
  /// seem to overlap.
  static bool before(const std::pair<Place, EdgeCrossing>& a, const std::pair<Place, EdgeCrossing>& b) {
    const auto size = [](const Place& place) {
      return std::max({std::abs(static_cast<double>(place.height.x)), std::abs(static_cast<double>(place.height.y)),
                       std::abs(static_cast<double>(place.height.z))});
    };
    const double difference = a.first.value - b.first.value;
    constexpr double rounding = 32 * 0x1p-53;  // values are means of heights
    if (std::abs(difference) > rounding * (size(a.first) + size(b.first))) return difference < 0;
    const Int512 left = exactHeight(a.first) * wide(b.first.total), right = exactHeight(b.first) * wide(a.first.total);
    if (left != right) return left < right;
    return std::pair(a.second.step, a.second.point) < std::pair(b.second.step, b.second.point);
  }

  const CutSurface& cut_;
  const SolidSurface& surface_;
  const CellDiagram& diagram_;
};

void findCrossings(CellEdges& result, const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram) {
  using Named = std::pair<std::array<std::uint32_t, 3>, std::uint32_t>;
  std::vector<Named> points;
  for (std::uint32_t p = 0; p < cut.points.size(); ++p) {
    const CutPoint& point = cut.points[p];
    if (point.kind == CutPoint::inTriangle) points.push_back({{point.of[1], point.of[2], point.of[3]}, p});
  }
  std::sort(points.begin(), points.end());
  const EdgeOrder order(cut, surface, diagram);
  std::vector<std::uint32_t> ofEdge;
  auto next = points.begin();
  for (CellEdge& edge : result.edges) {
    ofEdge.clear();
    for (; next != points.end() && next->first == edge.cells; ++next) ofEdge.push_back(next->second);
    order.add(edge, ofEdge, result.crossings);
  }
  CHECK(next == points.end(), "{} crossings of no edge", points.end() - next);
}

int stepAlong(const CellEdges& edges, const CellEdge& edge) {
  int step = 0;
  for (std::uint32_t n = 0; n < edge.count; ++n) step += edges.crossings[edge.first + n].step;
  return step;
}

/// Outside all around, where ghosts are; from there along edges, a step at each crossing.
void findWinding(CellEdges& result, const CellDiagram& diagram) {
  constexpr int unknown = 1 << 30;
  const auto& tetrahedra = diagram.tetrahedra();
  result.winding.assign(tetrahedra.size(), unknown);
  std::vector<std::uint32_t> open;
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    const auto& seeds = tetrahedra[t].seeds;
    if (std::none_of(seeds.begin(), seeds.end(), [&](std::uint32_t s) { return diagram.isGhost(s); })) continue;
    result.winding[t] = 0;
    open.push_back(t);
  }
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    for (const std::uint32_t e : result.edgeOf[t]) {
      if (e == CellEdges::noEdge) continue;
      const CellEdge& edge = result.edges[e];
      const int step = stepAlong(result, edge);
      const std::uint32_t other = edge.from == t ? edge.to : edge.from;
      const int there = result.winding[t] + (edge.from == t ? step : -step);
      CHECK(result.winding[other] == unknown || result.winding[other] == there, "winding {} and {} at one point",
            result.winding[other], there);
      if (result.winding[other] != unknown) continue;
      result.winding[other] = there;
      open.push_back(other);
    }
  }
}

/// 2 also where it falls below 0: there, too, the surface bounds no body.
int deepestWinding(const CellEdges& edges) {
  int deepest = 1;
  for (const CellEdge& edge : edges.edges) {
    int winding = edges.winding[edge.from];
    for (std::uint32_t n = 0; n <= edge.count; ++n) {
      deepest = std::max(deepest, winding < 0 ? 2 : winding);
      if (n < edge.count) winding += edges.crossings[edge.first + n].step;
    }
  }
  return deepest;
}

}  // namespace

CellEdges cellEdges(const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram) {
  CellEdges result;
  result.edges = findEdges(diagram, result.edgeOf);
  findCrossings(result, cut, surface, diagram);
  findWinding(result, diagram);
  result.deepestWinding = deepestWinding(result);
  return result;
}

}  // namespace brisance
