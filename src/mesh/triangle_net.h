// A triangulation being worked on: triangles that know their neighbours, split and flipped in constant time.
#pragma once

#include "mesh/mesh_topology.h"

namespace brisance {

class TriangleNet {
 public:
  TriangleNet(std::vector<Triangle> triangles, std::size_t vertexCount)
      : triangles_(std::move(triangles)), neighbours_(edgeNeighbours(triangles_, vertexCount)) {}

  /// Room for so many triangles.
  void reserve(std::size_t count) {
    triangles_.reserve(count);
    neighbours_.reserve(count);
  }
  /// Gives the triangles away, once the work is done.
  std::vector<Triangle> release() { return std::move(triangles_); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Across each edge (edge e joins corners e and e + 1), noTriangle at the border.
  const std::vector<Triangle>& neighbours() const { return neighbours_; }
  /// Which edge of `triangle` touches `neighbour`.
  int edgeTo(std::uint32_t triangle, std::uint32_t neighbour) const;

  /// A point inside makes three of one: `triangle` and two at the end of the list.
  void splitInside(std::uint32_t triangle, std::uint32_t point);
  /// A point on an edge halves the triangles on both sides (one at the border). The new halves are at the end of the
  /// list, that of `triangle` first.
  void splitEdge(std::uint32_t triangle, int edge, std::uint32_t point);
  /// Exchanges the diagonal of the quadrilateral made of the triangles on both sides of an inner edge.
  void flip(std::uint32_t triangle, int edge);

 private:
  /// Halves one triangle; returns the number of the half beside the edge's end, `triangle` keeps that beside its start.
  std::uint32_t halve(std::uint32_t triangle, int edge, std::uint32_t point);
  void set(std::uint32_t triangle, const Triangle& corners, const Triangle& neighbours);
  std::uint32_t append(const Triangle& corners, const Triangle& neighbours);
  void relink(std::uint32_t triangle, std::uint32_t from, std::uint32_t to);

  std::vector<Triangle> triangles_;
  std::vector<Triangle> neighbours_;
};

}  // namespace brisance
