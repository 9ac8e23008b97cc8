#include "rigid/collision_shapes.h"

#include <limits>

#include "base/parallel.h"
#include "mesh/convex_parts.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

Vec3d normalOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  return normalized(cross(b - a, c - a));
}

/// How far directions may lean over edge k towards the triangle beyond it.
double leaningOver(const TriangleMesh& mesh, const Vec3d& outward, std::uint32_t neighbour) {
  if (neighbour == noTriangle) return 1;
  return std::max(0.0, dot(normalOf(mesh, neighbour), outward));
}

void addTriangles(const TriangleMesh& mesh, CollisionShape& shape) {
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh);
  const bool closed = isClosed(mesh);
  std::vector<Box3> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::array<Vec3d, 3> corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    const Vec3d normal = normalOf(mesh, t);
    if (!(length(normal) > 0)) continue;
    SurfaceTriangle triangle{triangleSheet(corners[0], corners[1], corners[2], !closed), {}, {}};
    for (int k = 0; k < 3; ++k) {
      triangle.outward[k] = normalized(cross(corners[(k + 1) % 3] - corners[k], normal));
      triangle.leaning[k] = leaningOver(mesh, triangle.outward[k], neighbours[t][k]);
    }
    boxes.push_back(bounds(triangle.sheet));
    shape.triangles.push_back(std::move(triangle));
  }
  shape.tree = std::make_shared<const BoxTree>(std::move(boxes));
}

TriangleMesh placedMesh(const TriangleMesh& mesh, const Pose& pose) {
  TriangleMesh placed = welded(mesh);
  for (Vec3d& v : placed.vertices) v = pose * v;
  return placed;
}

/// One hull where it is the mesh, else the triangles.
void addScenery(const TriangleMesh& mesh, const Pose& pose, CollisionShape& shape) {
  constexpr double exact = 1e-6;
  const TriangleMesh placed = placedMesh(mesh, pose);
  shape.box = bounds(placed);
  shape.thickness = std::numeric_limits<double>::infinity();
  const bool mayBeConvex = isClosed(placed);
  if (mayBeConvex) shape.parts = convexParts(mesh, {2, exact});
  if (shape.parts.size() == 1) return;
  shape.parts.clear();
  addTriangles(placed, shape);
}

}  // namespace

CollisionShape movingShape(const TriangleMesh& mesh) {
  CollisionShape shape;
  constexpr double leastThickness = 1e-3;  // of the radius: open shells have none of their own
  for (const Vec3d& v : mesh.vertices) shape.radius = std::max(shape.radius, length(v));
  shape.parts = convexParts(mesh);
  shape.thickness = shape.radius;
  for (const ConvexSolid& part : shape.parts) shape.thickness = std::min(shape.thickness, thickness(part));
  shape.thickness = std::max(shape.thickness, leastThickness * shape.radius);
  return shape;
}

std::vector<CollisionShape> collisionShapes(const RigidBodies& bodies) {
  std::vector<CollisionShape> shapes(bodies.size());
  parallelFor(0, static_cast<std::int64_t>(bodies.size()), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b)
      if (bodies.inverseMass[b] > 0)
        shapes[b] = movingShape(*bodies.mesh[b]);
      else
        addScenery(*bodies.mesh[b], {bodies.position[b], bodies.orientation[b]}, shapes[b]);
  });
  return shapes;
}

}  // namespace brisance
