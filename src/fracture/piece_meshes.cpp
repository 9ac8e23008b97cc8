#include "fracture/piece_meshes.h"

#include <map>
#include <numeric>
#include <unordered_map>

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {
namespace {

/// A surface vertex with one of the mesh's vertices: what a corner of an uncut triangle is. Without normals and uvs a
/// surface vertex has but one.
struct Wedges {
  std::vector<Triangle> ofTriangle;
  std::vector<std::uint32_t> vertex;  ///< of the surface
  std::vector<std::uint32_t> source;  ///< of the mesh
};

Wedges wedgesOf(const SolidSurface& surface, bool attributes) {
  Wedges wedges;
  wedges.ofTriangle = surface.triangles;
  wedges.vertex.resize(surface.places.size());
  std::iota(wedges.vertex.begin(), wedges.vertex.end(), 0u);
  wedges.source.assign(surface.places.size(), noVertex);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> further;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = surface.triangles[t][k], source = surface.corners[t][k];
      if (wedges.source[vertex] == noVertex) wedges.source[vertex] = source;
      if (wedges.source[vertex] == source || !attributes) continue;
      const auto [place, isNew] =
          further.try_emplace({vertex, source}, static_cast<std::uint32_t>(wedges.vertex.size()));
      if (isNew) {
        wedges.vertex.push_back(vertex);
        wedges.source.push_back(source);
      }
      wedges.ofTriangle[t][k] = place->second;
    }
  return wedges;
}

/// Numbers of parts in rows by piece.
struct PieceRows {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> numbers;
  template <class PieceOf>
  PieceRows(std::size_t count, int pieces, const PieceOf& pieceOf) : first(pieces + 1, 0) {
    for (std::size_t n = 0; n < count; ++n)
      if (pieceOf(n) >= 0) ++first[pieceOf(n) + 1];
    for (int p = 0; p < pieces; ++p) first[p + 1] += first[p];
    numbers.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t n = 0; n < count; ++n)
      if (pieceOf(n) >= 0) numbers[next[pieceOf(n)]++] = static_cast<std::uint32_t>(n);
  }
  std::span<const std::uint32_t> of(int piece) const {
    return {numbers.data() + first[piece], first[piece + 1] - first[piece]};
  }
};

/// -1: of no piece.
auto ofAtoms(const std::vector<int>& atoms, const Partition& pieces) {
  return [&atoms, &pieces](std::size_t n) { return atoms[n] < 0 ? -1 : pieces.pieceOf[atoms[n]]; };
}
/// Faces inside a piece vanish.
auto ofCaps(const CellAtoms& atoms, const Partition& pieces, int side) {
  return [&atoms, &pieces, side](std::size_t n) {
    const int low = pieces.pieceOf[atoms.ofCapTriangle[n][0]], high = pieces.pieceOf[atoms.ofCapTriangle[n][1]];
    return low == high ? -1 : side == 0 ? low : high;
  };
}

/// Everything sorted by piece, and a scratch number for each wedge, which lies in one piece only.
struct Assembly {
  Assembly(const TriangleMesh& mesh_, const CellComplex& complex_, const CellAtoms& atoms_, const Partition& pieces_)
      : mesh(mesh_),
        complex(complex_),
        attributes(!mesh.normals.empty() || !mesh.uvs.empty()),
        wedges(wedgesOf(complex.surface, attributes)),
        localOf(wedges.vertex.size(), noVertex),
        capOf(complex.capTriangles.size()),
        triangles(atoms_.ofTriangle.size(), pieces_.count, ofAtoms(atoms_.ofTriangle, pieces_)),
        polygons(atoms_.ofPolygon.size(), pieces_.count, ofAtoms(atoms_.ofPolygon, pieces_)),
        lowCaps(capOf.size(), pieces_.count, ofCaps(atoms_, pieces_, 0)),
        highCaps(capOf.size(), pieces_.count, ofCaps(atoms_, pieces_, 1)) {
    for (std::uint32_t c = 0; c < complex.caps.size(); ++c)
      for (std::uint32_t n = 0; n < complex.caps[c].count; ++n) capOf[complex.caps[c].first + n] = c;
  }

  const TriangleMesh& mesh;
  const CellComplex& complex;
  bool attributes;
  Wedges wedges;
  std::vector<std::uint32_t> localOf;
  std::vector<std::uint32_t> capOf;
  PieceRows triangles, polygons, lowCaps, highCaps;
};

/// Of a new vertex, what tells it from others at its place.
struct NewCorner {
  std::uint32_t vertex, a, b;
  friend bool operator==(const NewCorner&, const NewCorner&) = default;
};
struct NewCornerHash {
  std::size_t operator()(const NewCorner& c) const {
    const std::uint64_t hash = (c.vertex * 0x9E3779B97F4A7C15u) ^ (c.a * 0xBF58476D1CE4E5B9u) ^ c.b;
    return hash ^ (hash >> 29);
  }
};

class PieceBuilder {
 public:
  PieceBuilder(Assembly& assembly, int piece) : all_(assembly), piece_(piece) {}

  TriangleMesh build() {
    nameMaterials();
    reserve();
    for (const std::uint32_t t : all_.triangles.of(piece_)) addTriangle(t);
    for (const std::uint32_t p : all_.polygons.of(piece_)) addPolygon(all_.complex.cut.polygons[p]);
    for (const std::uint32_t t : all_.lowCaps.of(piece_)) addCapTriangle(t, false);
    for (const std::uint32_t t : all_.highCaps.of(piece_)) addCapTriangle(t, true);
    return std::move(out_);
  }

 private:
  void nameMaterials() {
    out_.materialNames = all_.mesh.materialNames;
    if (out_.materialNames.empty()) out_.materialNames.push_back("outside");
    inside_ = static_cast<std::uint16_t>(out_.materialNames.size());
    out_.materialNames.push_back("inside");
  }
  void reserve() {
    const std::size_t count = all_.triangles.of(piece_).size() + 4 * all_.polygons.of(piece_).size() +
                              all_.lowCaps.of(piece_).size() + all_.highCaps.of(piece_).size();
    out_.triangles.reserve(count);
    out_.materials.reserve(count);
    out_.vertices.reserve(count / 2 + 3 * all_.polygons.of(piece_).size());
    local_.reserve(2 * all_.polygons.of(piece_).size());
  }

  std::uint32_t addVertex(const Vec3d& place, const Vec3d& normal, const Vec2d& uv) {
    out_.vertices.push_back(place);
    if (!all_.mesh.normals.empty()) out_.normals.push_back(normal);
    if (!all_.mesh.uvs.empty()) out_.uvs.push_back(uv);
    return static_cast<std::uint32_t>(out_.vertices.size() - 1);
  }
  Vec3d sourceNormal(std::uint32_t v) const { return all_.mesh.normals.empty() ? Vec3d{} : all_.mesh.normals[v]; }
  Vec2d sourceUv(std::uint32_t v) const { return all_.mesh.uvs.empty() ? Vec2d{} : all_.mesh.uvs[v]; }
  std::uint16_t materialOf(std::uint32_t triangle) const {
    return all_.mesh.materials.empty() ? 0 : all_.mesh.materials[all_.complex.surface.faces[triangle]];
  }

  std::uint32_t wedge(std::uint32_t number) {
    std::uint32_t& local = all_.localOf[number];
    if (local == noVertex) {
      const std::uint32_t source = all_.wedges.source[number];
      local = addVertex(all_.complex.places[all_.wedges.vertex[number]], sourceNormal(source), sourceUv(source));
    }
    return local;
  }

  void addTriangle(std::uint32_t t) {
    const auto& [a, b, c] = all_.wedges.ofTriangle[t];
    const std::uint32_t x = wedge(a), y = wedge(b), z = wedge(c);
    out_.triangles.push_back({x, y, z});
    out_.materials.push_back(materialOf(t));
  }

  int cornerOf(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& t = all_.complex.surface.triangles[triangle];
    return static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
  }

  /// A mix of mesh vertices at a new vertex of the cut.
  template <std::size_t Count>
  std::uint32_t addMixed(std::uint32_t vertex, const std::array<std::uint32_t, Count>& sources, const Vec3d& shares) {
    Vec3d normal;
    Vec2d uv;
    for (std::size_t n = 0; n < Count; ++n) {
      normal += sourceNormal(sources[n]) * shares[static_cast<int>(n)];
      uv = uv + sourceUv(sources[n]) * shares[static_cast<int>(n)];
    }
    return addVertex(all_.complex.places[vertex], normalized(normal), uv);
  }

  std::uint32_t cutCorner(std::uint32_t triangle, std::uint32_t vertex) {
    const CutPoint& point = all_.complex.cut.points[vertex - all_.complex.firstPoint()];
    const Triangle& corners = all_.complex.surface.corners[triangle];
    NewCorner key{vertex, 0, 0};
    const bool onEdge = point.kind == CutPoint::onEdge;
    std::array<std::uint32_t, 2> ends{};
    if (all_.attributes && onEdge) {
      ends = {corners[cornerOf(triangle, point.of[0])], corners[cornerOf(triangle, point.of[1])]};
      key = {vertex, ends[0], ends[1]};
    }
    const auto [place, isNew] = local_.try_emplace(key, 0);
    if (!isNew) return place->second;
    if (!all_.attributes) return place->second = addVertex(all_.complex.places[vertex], {}, {});
    const Vec3d shares = sharesOf(point, all_.complex.cut, all_.complex.surface, all_.complex.diagram);
    return place->second = onEdge ? addMixed(vertex, ends, shares) : addMixed(vertex, corners, shares);
  }

  std::uint32_t outsideCorner(std::uint32_t triangle, std::uint32_t vertex) {
    if (vertex >= all_.complex.firstPoint()) return cutCorner(triangle, vertex);
    return wedge(all_.wedges.ofTriangle[triangle][cornerOf(triangle, vertex)]);
  }

  void addPolygon(const CutPolygon& polygon) {
    const std::uint32_t* corners = &all_.complex.cut.corners[polygon.first];
    const std::uint32_t first = outsideCorner(polygon.triangle, corners[0]);
    std::uint32_t before = outsideCorner(polygon.triangle, corners[1]);
    for (std::uint32_t n = 2; n < polygon.count; ++n) {
      const std::uint32_t next = outsideCorner(polygon.triangle, corners[n]);
      out_.triangles.push_back({first, before, next});
      out_.materials.push_back(materialOf(polygon.triangle));
      before = next;
    }
  }

  /// Outward normal of a face between cells, from the low one to the high one.
  Vec3d capNormal(const Cap& cap) const {
    const auto& seeds = all_.complex.diagram.seeds();
    return normalized(Vec3d(seeds[cap.highCell].place - seeds[cap.lowCell].place));
  }
  static Vec2d flatUv(const Vec3d& place, const Vec3d& normal) {
    Vec3d helper;
    helper[std::abs(normal.y) < 0.7 ? 1 : 0] = 1;  // any direction well away from the normal
    const Vec3d u = normalized(cross(helper, normal));
    return {dot(place, u), dot(place, cross(normal, u))};
  }

  std::uint32_t insideCorner(std::uint32_t vertex, std::uint32_t cap, bool turned) {
    constexpr std::uint32_t insideMark = 0x80000000u;  // beyond all vertices of the mesh
    const NewCorner key = all_.attributes ? NewCorner{vertex, cap, insideMark + turned} : NewCorner{vertex, 0, 0};
    const auto [place, isNew] = local_.try_emplace(key, 0);
    if (!isNew) return place->second;
    if (!all_.attributes) return place->second = addVertex(all_.complex.places[vertex], {}, {});
    const Vec3d normal = capNormal(all_.complex.caps[cap]) * (turned ? -1.0 : 1.0);
    return place->second = addVertex(all_.complex.places[vertex], normal, flatUv(all_.complex.places[vertex], normal));
  }

  void addCapTriangle(std::uint32_t t, bool turned) {
    Triangle triangle = all_.complex.capTriangles[t];
    for (std::uint32_t& corner : triangle) corner = insideCorner(corner, all_.capOf[t], turned);
    if (turned) std::swap(triangle[1], triangle[2]);
    out_.triangles.push_back(triangle);
    out_.materials.push_back(inside_);
  }

  Assembly& all_;
  int piece_;
  std::uint16_t inside_ = 0;
  std::unordered_map<NewCorner, std::uint32_t, NewCornerHash> local_;
  TriangleMesh out_;
};

struct PieceEdge {
  int piece;
  std::uint32_t low, high;
  bool rising;
  friend auto operator<=>(const PieceEdge&, const PieceEdge&) = default;  // NOLINT(modernize-use-nullptr)
};

/// The sides of a triangle between two new vertices.
void addEdges(std::vector<PieceEdge>& edges, int piece, const Triangle& t, std::uint32_t firstPoint, bool turned) {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3];
    if (a >= firstPoint && b >= firstPoint) edges.push_back({piece, std::min(a, b), std::max(a, b), (a < b) != turned});
  }
}

}  // namespace

std::vector<TriangleMesh> pieceMeshes(const TriangleMesh& mesh, const CellComplex& complex, const CellAtoms& atoms,
                                      const Partition& pieces) {
  Assembly assembly(mesh, complex, atoms, pieces);
  std::vector<TriangleMesh> meshes(pieces.count);
  parallelFor(0, pieces.count, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t p = begin; p < end; ++p) meshes[p] = PieceBuilder(assembly, static_cast<int>(p)).build();
  });
  return meshes;
}

bool piecesAreManifold(const CellComplex& complex, const CellAtoms& atoms, const Partition& pieces) {
  std::vector<PieceEdge> edges;
  const std::uint32_t firstPoint = complex.firstPoint();
  for (std::size_t p = 0; p < complex.cut.polygons.size(); ++p) {
    const CutPolygon& polygon = complex.cut.polygons[p];
    const std::uint32_t* corners = &complex.cut.corners[polygon.first];
    for (std::uint32_t n = 1; n + 1 < polygon.count; ++n)
      addEdges(edges, pieces.pieceOf[atoms.ofPolygon[p]], {corners[0], corners[n], corners[n + 1]}, firstPoint, false);
  }
  for (std::size_t t = 0; t < complex.capTriangles.size(); ++t) {
    const int low = pieces.pieceOf[atoms.ofCapTriangle[t][0]], high = pieces.pieceOf[atoms.ofCapTriangle[t][1]];
    if (low == high) continue;
    addEdges(edges, low, complex.capTriangles[t], firstPoint, false);
    addEdges(edges, high, complex.capTriangles[t], firstPoint, true);
  }
  std::sort(edges.begin(), edges.end());
  const auto sameLine = [](const PieceEdge& a, const PieceEdge& b) {
    return a.piece == b.piece && a.low == b.low && a.high == b.high;
  };
  for (std::size_t n = 0; n < edges.size(); n += 2) {
    if (n + 1 == edges.size() || !sameLine(edges[n], edges[n + 1]) || edges[n].rising == edges[n + 1].rising)
      return false;
    if (n + 2 < edges.size() && sameLine(edges[n], edges[n + 2])) return false;
  }
  return true;
}

std::vector<Contact> pieceContacts(const CellAtoms& atoms, const Partition& pieces) {
  std::map<std::pair<int, int>, Contact> byPair;
  for (const Contact& contact : atoms.contacts) {
    int a = pieces.pieceOf[contact.a], b = pieces.pieceOf[contact.b];
    if (a == b) continue;
    const double sense = a < b ? 1 : -1;
    if (a > b) std::swap(a, b);
    Contact& sum = byPair[{a, b}];
    sum.a = a;
    sum.b = b;
    sum.area += contact.area;
    sum.normal += contact.normal * sense;
    sum.place += contact.place * contact.area;
  }
  std::vector<Contact> result;
  for (auto& [pair, contact] : byPair) {
    if (contact.area > 0) contact.place = contact.place / contact.area;
    result.push_back(contact);
  }
  return result;
}

}  // namespace brisance
