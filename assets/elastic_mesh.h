// A closed manifold mesh whose triangles may be split, joined and turned.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance::samples {

/// Every operation is refused (false, and nothing changes) if it would leave a surface that is not manifold, or fold a
/// triangle over.
class ElasticMesh {
 public:
  explicit ElasticMesh(const TriangleMesh& mesh);

  struct Edge {
    std::uint32_t a, b;  ///< vertices, a < b
  };
  /// All edges, in an order that depends on the mesh alone.
  std::vector<Edge> edges() const;
  bool has(const Edge& edge) const;
  std::size_t triangleCount() const { return alive_; }
  std::size_t vertexCount() const { return places_.size(); }  ///< with those that are gone
  const Vec3d& place(std::uint32_t vertex) const { return places_[vertex]; }
  void move(std::uint32_t vertex, const Vec3d& place) { places_[vertex] = place; }
  double lengthOf(const Edge& edge) const { return length(places_[edge.a] - places_[edge.b]); }
  /// Vertices that share an edge with this one, in the order of their numbers; none where the vertex is gone.
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;
  Vec3d normalAt(std::uint32_t vertex) const;  ///< unit, by the area of the triangles around

  /// A new vertex on the edge.
  void split(const Edge& edge, const Vec3d& place);
  /// Both ends become one vertex.
  bool collapse(const Edge& edge, const Vec3d& place);
  /// The edge's two triangles are divided the other way, if that evens out the numbers of neighbours.
  bool flip(const Edge& edge);

  TriangleMesh mesh() const;

 private:
  /// The two triangles of an edge, and their corners off it: `left` has a before b.
  struct Wings {
    std::uint32_t left, right, leftCorner, rightCorner;
  };
  Wings wingsOf(const Edge& edge) const;
  int valence(std::uint32_t vertex) const { return static_cast<int>(around_[vertex].size()); }
  Vec3d areaVector(const Triangle& t) const;
  bool turnsOver(std::uint32_t vertex, const Edge& collapsing, const Vec3d& place) const;
  void attach(std::uint32_t triangle);
  void detach(std::uint32_t triangle);
  void replaceCorner(std::uint32_t triangle, std::uint32_t from, std::uint32_t to);

  std::vector<Vec3d> places_;
  std::vector<Triangle> triangles_;
  std::vector<bool> gone_;                          ///< per triangle
  std::vector<std::vector<std::uint32_t>> around_;  ///< triangles of each vertex
  std::size_t alive_ = 0;
};

}  // namespace brisance::samples
