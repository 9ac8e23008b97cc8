#include "fracture/cell_caps.h"

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/distinct_places.h"
#include "mesh/polygon_fill.h"

namespace brisance {
namespace {

struct DirectedEdge {
  std::uint32_t from, to;
  friend auto operator<=>(const DirectedEdge&, const DirectedEdge&) = default;  // NOLINT(modernize-use-nullptr)
};

/// The border of one face inside the body.
struct FaceBorder {
  std::uint32_t lowCell, highCell;
  std::vector<DirectedEdge> edges;
};

/// A tetrahedron with two of its seeds named; the other two follow one another counter-clockwise about them.
struct PairCorner {
  std::uint32_t low, high, tetrahedron;
  friend auto operator<=>(const PairCorner&, const PairCorner&) = default;  // NOLINT(modernize-use-nullptr)
};

std::vector<PairCorner> pairCorners(const CellDiagram& diagram) {
  std::vector<PairCorner> corners;
  const auto& tetrahedra = diagram.tetrahedra();
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t)
    for (const std::uint32_t low : tetrahedra[t].seeds)
      for (const std::uint32_t high : tetrahedra[t].seeds)
        if (low < high && !diagram.isGhost(high)) corners.push_back({low, high, t});
  std::sort(corners.begin(), corners.end());
  return corners;
}

class BorderFinder {
 public:
  BorderFinder(const CellComplex& complex, const CellEdges& edges) : complex_(complex), edges_(edges) {
    vertexOf_.assign(edges.winding.size(), noVertex);
    for (std::uint32_t n = 0; n < complex.meetings.size(); ++n)
      vertexOf_[complex.meetings[n]] = complex.firstMeeting() + n;
  }

  /// Faces that lie inside, at least in part.
  std::vector<FaceBorder> borders() const {
    std::vector<FaceBorder> result;
    const std::vector<PairCorner> corners = pairCorners(complex_.diagram);
    auto segment = complex_.cut.segments.begin();
    for (auto corner = corners.begin(); corner != corners.end();) {
      FaceBorder border{corner->low, corner->high, {}};
      for (; segment != complex_.cut.segments.end() && segment->lowCell == border.lowCell &&
             segment->highCell == border.highCell;
           ++segment)
        border.edges.push_back({segment->from, segment->to});
      addCellEdges(border, corner->tetrahedron);
      if (!border.edges.empty()) result.push_back(std::move(border));
      const auto pair = std::pair(corner->low, corner->high);
      while (corner != corners.end() && std::pair(corner->low, corner->high) == pair) ++corner;
    }
    CHECK(segment == complex_.cut.segments.end(), "a segment between cells {} and {} that do not touch",
          segment->lowCell, segment->highCell);
    return result;
  }

 private:
  /// Once around the line from the low seed to the high one, counter-clockwise about it.
  void addCellEdges(FaceBorder& border, std::uint32_t start) const {
    std::uint32_t t = start;
    do {
      const Tetrahedron& tetrahedron = complex_.diagram.tetrahedra()[t];
      const int face = faceBehind(tetrahedron, border);
      const std::uint32_t next = tetrahedron.neighbours[face];
      const std::uint32_t edge = edges_.edgeOf[t][face];
      if (edge != CellEdges::noEdge) addStretches(border, edges_.edges[edge], edges_.edges[edge].from == t);
      t = next;
    } while (t != start);
  }

  /// With seeds (low, high, k, l) in positive order the way round goes from k to l: through the face opposite k.
  static int faceBehind(const Tetrahedron& t, const FaceBorder& border) {
    const auto at = [&](std::uint32_t seed) {
      return static_cast<int>(std::find(t.seeds.begin(), t.seeds.end(), seed) - t.seeds.begin());
    };
    const int low = at(border.lowCell), high = at(border.highCell);
    int others[2], n = 0;
    for (int corner = 0; corner < 4; ++corner)
      if (corner != low && corner != high) others[n++] = corner;
    const std::array<int, 4> order{low, high, others[0], others[1]};
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
    return inversions % 2 == 0 ? others[0] : others[1];
  }

  /// The stretches of an edge that lie inside, once for each winding of the surface about them.
  void addStretches(FaceBorder& border, const CellEdge& edge, bool forward) const {
    int winding = edges_.winding[edge.from];
    std::uint32_t from = vertexOf_[edge.from];
    for (std::uint32_t n = 0; n <= edge.count; ++n) {
      const EdgeCrossing* crossing = n < edge.count ? &edges_.crossings[edge.first + n] : nullptr;
      const std::uint32_t to = crossing ? complex_.firstPoint() + crossing->point : vertexOf_[edge.to];
      const DirectedEdge stretch = (winding > 0) == forward ? DirectedEdge{from, to} : DirectedEdge{to, from};
      for (int times = 0; times < std::abs(winding); ++times) border.edges.push_back(stretch);
      if (crossing) winding += crossing->step;
      from = to;
    }
  }

  const CellComplex& complex_;
  const CellEdges& edges_;
  std::vector<std::uint32_t> vertexOf_;  ///< of tetrahedra
};

/// As many edges leave each vertex as arrive: the border falls into loops.
std::vector<std::vector<std::uint32_t>> loopsOf(std::vector<DirectedEdge> edges) {
  std::sort(edges.begin(), edges.end());
  std::vector<bool> used(edges.size(), false);
  const auto leaving = [&](std::uint32_t vertex) {
    auto edge = std::lower_bound(edges.begin(), edges.end(), DirectedEdge{vertex, 0}) - edges.begin();
    while (static_cast<std::size_t>(edge) < edges.size() && used[edge]) ++edge;
    CHECK(static_cast<std::size_t>(edge) < edges.size() && edges[edge].from == vertex, "a border ends at vertex {}",
          vertex);
    return static_cast<std::size_t>(edge);
  };
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first]) continue;
    loops.emplace_back();
    std::size_t edge = first;
    do {
      used[edge] = true;
      loops.back().push_back(edges[edge].from);
      if (edges[edge].to == edges[first].from) break;
      edge = leaving(edges[edge].to);
    } while (edge != first);
  }
  return loops;
}

/// The plane's two axes among x, y, z whose area is least foreshortened, in the order that keeps the face's sense.
std::pair<int, int> flatAxes(const Vec3l& normal) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return normal[axis] > 0 ? std::pair(u, v) : std::pair(v, u);
}

/// Coordinates in the face's own plane, true to shape.
std::vector<Vec2d> flattened(const CellComplex& complex, const FaceBorder& border,
                             const std::vector<std::uint32_t>& vertices) {
  const Vec3l normal = complex.diagram.seeds()[border.highCell].place - complex.diagram.seeds()[border.lowCell].place;
  const Vec3d n = normalized(Vec3d(normal));
  Vec3d helper;
  helper[flatAxes(normal).first] = 1;
  const Vec3d u = normalized(cross(helper, n)), v = cross(n, u);
  const Vec3d origin = complex.places[vertices[0]];
  std::vector<Vec2d> points;
  for (const std::uint32_t vertex : vertices) {
    const Vec3d p = complex.places[vertex] - origin;
    points.push_back({dot(p, u), dot(p, v)});
  }
  return points;
}

/// Triangles over the vertices of its border alone.
std::vector<Triangle> fill(const CellComplex& complex, const FaceBorder& border) {
  std::vector<std::vector<std::uint32_t>> loops = loopsOf(border.edges);
  // There and back along one line: two triangles of the surface lie on one another and close without a cap.
  std::erase_if(loops, [](const auto& loop) { return loop.size() < 3; });
  if (loops.empty()) return {};
  std::vector<std::uint32_t> vertices;
  for (const auto& loop : loops) vertices.insert(vertices.end(), loop.begin(), loop.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (auto& loop : loops)
    for (std::uint32_t& vertex : loop)
      vertex =
          static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  std::vector<Triangle> triangles = fillPolygon(flattened(complex, border, vertices), loops);
  for (Triangle& t : triangles)
    for (std::uint32_t& corner : t) corner = vertices[corner];
  return triangles;
}

void addCaps(CellComplex& complex, const std::vector<FaceBorder>& borders) {
  std::vector<std::vector<Triangle>> filled(borders.size());
  parallelFor(0, static_cast<std::int64_t>(borders.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) filled[b] = fill(complex, borders[b]);
  });
  for (std::size_t b = 0; b < borders.size(); ++b) {
    complex.caps.push_back({borders[b].lowCell, borders[b].highCell,
                            static_cast<std::uint32_t>(complex.capTriangles.size()),
                            static_cast<std::uint32_t>(filled[b].size())});
    complex.capTriangles.insert(complex.capTriangles.end(), filled[b].begin(), filled[b].end());
  }
}

Vec3d cutPlace(const CellComplex& complex, const CutPoint& point) {
  const Vec3d share = sharesOf(point, complex.cut, complex.surface, complex.diagram);
  const auto& places = complex.surface.places;
  if (point.kind == CutPoint::onEdge)
    return places[point.of[0]] + (places[point.of[1]] - places[point.of[0]]) * share.y;
  const Triangle& t = complex.surface.triangles[point.of[0]];
  return places[t[0]] + (places[t[1]] - places[t[0]]) * share.y + (places[t[2]] - places[t[0]]) * share.z;
}

/// New vertices keep off one another and off the corners of the triangles that they cut.
void placeVertices(CellComplex& complex, const CellLattice& lattice) {
  complex.places = complex.surface.places;
  std::vector<Vec3d> points(complex.cut.points.size());
  parallelFor(0, static_cast<std::int64_t>(points.size()), 1024, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t p = begin; p < end; ++p) points[p] = cutPlace(complex, complex.cut.points[p]);
  });
  DistinctPlaces distinct(complex.surface.step);
  distinct.reserve(2 * points.size() + complex.meetings.size());
  std::vector<bool> taken(complex.surface.places.size(), false);
  for (const std::uint32_t vertex : complex.cut.corners) {
    if (vertex >= complex.firstPoint() || taken[vertex]) continue;
    taken[vertex] = true;
    distinct.take(complex.surface.places[vertex]);
  }
  for (const Vec3d& p : points) complex.places.push_back(distinct.take(p));
  for (const std::uint32_t t : complex.meetings)
    complex.places.push_back(
        distinct.take(lattice.place(complex.diagram.meetingPoint(complex.diagram.tetrahedra()[t]))));
}

std::vector<WeightedSeed> latticeSeeds(const CellLattice& lattice, const std::vector<Vec3d>& seeds,
                                       const std::vector<double>& weights) {
  constexpr double heaviest = 0x1p38;  // as far as the ghosts around the box reach; four times its side squared
  std::vector<WeightedSeed> result;
  const double metre = lattice.inSeedSteps(lattice.place({}) + Vec3d(1, 0, 0)).x;
  for (std::size_t n = 0; n < seeds.size(); ++n) {
    WeightedSeed seed{lattice.seed(seeds[n], n), 0};
    if (!weights.empty())
      seed.weight =
          static_cast<std::int64_t>(std::nearbyint(std::clamp(weights[n] * metre * metre, -heaviest, heaviest)));
    result.push_back(seed);
  }
  return result;
}

}  // namespace

CellComplex cellComplex(const SolidSurface& surface, const std::vector<Vec3d>& seeds,
                        const std::vector<double>& weights, std::uint64_t shake) {
  Box3 box;
  for (const Vec3d& p : surface.places) box.include(p);
  const CellLattice lattice(box, shake);
  CellComplex complex{surface, CellDiagram(latticeSeeds(lattice, seeds, weights)), {}, {}, {}, {}, {}};
  complex.cut = cutSurface(complex.surface, complex.diagram, lattice);
  const CellEdges edges = cellEdges(complex.cut, complex.surface, complex.diagram);
  complex.overlaps = edges.deepestWinding > 1;
  for (std::uint32_t t = 0; t < edges.winding.size(); ++t)
    if (edges.winding[t] != 0) complex.meetings.push_back(t);
  placeVertices(complex, lattice);
  addCaps(complex, BorderFinder(complex, edges).borders());
  return complex;
}

}  // namespace brisance
