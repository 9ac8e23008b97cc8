// Which triangles touch.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

constexpr std::uint32_t noTriangle = 0xFFFFFFFFu;

/// Per triangle, the neighbour across each edge (edge e joins corners e and e + 1), noTriangle at a border. An edge of
/// more than two triangles pairs them in order of their numbers.
std::vector<Triangle> edgeNeighbours(const TriangleMesh& mesh);
std::vector<Triangle> edgeNeighbours(const std::vector<Triangle>& triangles, std::size_t vertexCount);

/// Every edge is used exactly once in each direction; a mesh of no triangles bounds nothing.
bool isClosed(const TriangleMesh& mesh);
/// Every edge is used as often in one direction as in the other, so that there is an inside and an outside: also where
/// more than two triangles share an edge, because the surface touches itself there.
bool isWatertight(const TriangleMesh& mesh);
/// Per place the number of the first that equals it exactly (0 and -0 are equal).
std::vector<std::uint32_t> samePlaces(const std::vector<Vec3d>& places);
/// The bare surface: vertices at exactly the same place, doubled for their normals or uvs, are one again. Triangles
/// keep their numbers; the vertices that no longer serve stay in the list.
TriangleMesh welded(const TriangleMesh& mesh);
/// Number of parts connected across edges.
int componentCount(const TriangleMesh& mesh);

}  // namespace brisance
