#include "mesh/extrusion.h"

#include "base/check.h"
#include "mesh/disjoint_sets.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

/// Chosen triangles over vertices of their own: `origin` says which vertex of the whole each was.
struct LocalTriangles {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> origin;
};

LocalTriangles chosenTriangles(const FlatMesh& flat, const std::vector<std::uint32_t>& chosen) {
  LocalTriangles local;
  for (const std::uint32_t t : chosen) {
    CHECK(t < flat.triangles.size(), "triangle {} of {}", t, flat.triangles.size());
    local.triangles.push_back(flat.triangles[t]);
    local.origin.insert(local.origin.end(), flat.triangles[t].begin(), flat.triangles[t].end());
  }
  std::sort(local.origin.begin(), local.origin.end());
  local.origin.erase(std::unique(local.origin.begin(), local.origin.end()), local.origin.end());
  for (Triangle& t : local.triangles)
    for (std::uint32_t& v : t)
      v = static_cast<std::uint32_t>(std::lower_bound(local.origin.begin(), local.origin.end(), v) -
                                     local.origin.begin());
  return local;
}

std::uint32_t cornerAt(const std::vector<Triangle>& triangles, std::uint32_t triangle, std::uint32_t vertex) {
  const Triangle& t = triangles[triangle];
  return 3 * triangle + static_cast<std::uint32_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

/// Corners (3 triangle + corner) that are joined around their vertex by shared edges.
DisjointSets joinFans(const std::vector<Triangle>& triangles, const std::vector<Triangle>& neighbours) {
  DisjointSets sets(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = neighbours[t][edge], next = (edge + 1) % 3;
      if (other == noTriangle) continue;
      sets.join(3 * t + edge, cornerAt(triangles, other, triangles[t][edge]));
      sets.join(3 * t + next, cornerAt(triangles, other, triangles[t][next]));
    }
  return sets;
}

/// Each fan of triangles around a vertex gets a copy of that vertex: the solid's edges then have two sides each.
void splitFans(LocalTriangles& local, const std::vector<Triangle>& neighbours) {
  DisjointSets sets = joinFans(local.triangles, neighbours);
  std::vector<std::uint32_t> vertexOf(3 * local.triangles.size()), origin;
  for (std::uint32_t corner = 0; corner < vertexOf.size(); ++corner) {
    std::uint32_t& vertex = local.triangles[corner / 3][corner % 3];
    // The root is the lowest corner of its set, so it was numbered before the others.
    if (sets.root(corner) == corner) {
      vertexOf[corner] = static_cast<std::uint32_t>(origin.size());
      origin.push_back(local.origin[vertex]);
    }
    vertex = vertexOf[sets.root(corner)];
  }
  local.origin = std::move(origin);
}

/// Stretches a picture over a box: (0, 0) at its lower left corner.
struct PictureBox {
  Vec3d lower, size;
  Vec2d uv(const Vec2d& p) const { return {(p.x - lower.x) / size.x, (p.y - lower.y) / size.y}; }
};

PictureBox pictureBox(const FlatMesh& flat) {
  Box3 box;
  for (const Triangle& t : flat.triangles)
    for (const std::uint32_t v : t) box.include({flat.points[v].x, flat.points[v].y, 0});
  return {box.lower, box.size()};
}

void addVertices(TriangleMesh& solid, const FlatMesh& flat, const LocalTriangles& local, const PictureBox& picture,
                 double z) {
  for (const std::uint32_t v : local.origin) {
    solid.vertices.push_back({flat.points[v].x, flat.points[v].y, z});
    solid.uvs.push_back(picture.uv(flat.points[v]));
  }
}

}  // namespace

TriangleMesh extrude(const FlatMesh& flat, const std::vector<std::uint32_t>& triangles, double thickness) {
  LocalTriangles local = chosenTriangles(flat, triangles);
  const std::vector<Triangle> neighbours = edgeNeighbours(local.triangles, local.origin.size());
  splitFans(local, neighbours);
  TriangleMesh solid;
  const PictureBox picture = pictureBox(flat);
  addVertices(solid, flat, local, picture, thickness / 2);
  addVertices(solid, flat, local, picture, -thickness / 2);
  const auto below = static_cast<std::uint32_t>(local.origin.size());
  for (const auto& [a, b, c] : local.triangles) {
    solid.triangles.push_back({a, b, c});
    solid.triangles.push_back({a + below, c + below, b + below});
  }
  for (std::size_t t = 0; t < local.triangles.size(); ++t)
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (neighbours[t][edge] != noTriangle) continue;
      const std::uint32_t a = local.triangles[t][edge], b = local.triangles[t][(edge + 1) % 3];
      solid.triangles.push_back({a + below, b + below, b});
      solid.triangles.push_back({a + below, b, a});
    }
  return solid;
}

}  // namespace brisance
