#include "mesh/shapes.h"

#include "base/check.h"

namespace brisance {
namespace {

/// A latitude-longitude net: rows from the north pole (+y) down, columns counter-clockwise around y from +x (so towards
/// -z).
struct SphereNet {
  int columns, rows;  ///< of quadrilaterals
  Vec3d direction(int row, double column) const {
    const auto [sinPolar, cosPolar] = portableSinCos(pi * row / rows);
    const auto [sinAround, cosAround] = portableSinCos(2 * pi * column / columns);
    const double ring = row == 0 || row == rows ? 0 : sinPolar;
    return {ring * cosAround, cosPolar, -ring * sinAround};
  }
  /// v falls from 1 at the north pole: the thesis' v counts from the picture's top row.
  Vec2d uv(int row, double column) const { return {column / columns, 1 - static_cast<double>(row) / rows}; }
};

void addNetTriangles(TriangleMesh& mesh, const SphereNet& net, const auto& vertexAt) {
  for (int row = 0; row < net.rows; ++row)
    for (int column = 0; column < net.columns; ++column) {
      const std::uint32_t upper = vertexAt(row, column), lower = vertexAt(row + 1, column);
      const std::uint32_t upperNext = vertexAt(row, column + 1), lowerNext = vertexAt(row + 1, column + 1);
      if (row + 1 < net.rows) mesh.triangles.push_back({upper, lower, lowerNext});
      if (row > 0) mesh.triangles.push_back({upper, row + 1 < net.rows ? lowerNext : lower, upperNext});
    }
}

void addSphereVertex(TriangleMesh& mesh, const Vec3d& direction, double radius) {
  mesh.vertices.push_back(direction * radius);
  mesh.normals.push_back(direction);
}

TriangleMesh weldedSphere(const SphereNet& net, double radius) {
  TriangleMesh mesh;
  addSphereVertex(mesh, net.direction(0, 0), radius);
  for (int row = 1; row < net.rows; ++row)
    for (int column = 0; column < net.columns; ++column) addSphereVertex(mesh, net.direction(row, column), radius);
  addSphereVertex(mesh, net.direction(net.rows, 0), radius);
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  addNetTriangles(mesh, net, [&](int row, int column) -> std::uint32_t {
    if (row == 0) return 0;
    if (row == net.rows) return last;
    return static_cast<std::uint32_t>(1 + (row - 1) * net.columns + column % net.columns);
  });
  return mesh;
}

TriangleMesh sphereWithUv(const SphereNet& net, double radius) {
  TriangleMesh mesh;
  for (int row = 0; row <= net.rows; ++row)
    for (int column = 0; column <= net.columns; ++column) {
      addSphereVertex(mesh, net.direction(row, column % net.columns), radius);
      const bool pole = row == 0 || row == net.rows;
      mesh.uvs.push_back(net.uv(row, pole ? column + 0.5 : column));
    }
  addNetTriangles(mesh, net,
                  [&](int row, int column) { return static_cast<std::uint32_t>(row * (net.columns + 1) + column); });
  return mesh;
}

/// A quadrilateral from its lower left corner, with the ways its u and v run.
struct Face {
  Vec3d corner, right, up;
};

void addFace(TriangleMesh& mesh, const Face& face, const Vec2d& uvRepeat) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec2d uv : {Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{1, 1}, Vec2d{0, 1}}) {
    mesh.vertices.push_back(face.corner + face.right * uv.x + face.up * uv.y);
    mesh.normals.push_back(normalized(cross(face.right, face.up)));
    mesh.uvs.push_back({uv.x * uvRepeat.x, uv.y * uvRepeat.y});
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// Faces +z, -z, +x, -x, +y, -y; u runs to the right as each is seen from outside.
std::array<Face, 6> boxFaces(const Vec3d& size) {
  const Vec3d x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z}, low = size * -0.5, high = size * 0.5;
  return {{{low + z, x, y},
           {low + x, -x, y},
           {low + x + z, -z, y},
           {low, z, y},
           {low + y + z, x, -z},
           {high - x - y - z, x, z}}};
}

TriangleMesh weldedBox(const Vec3d& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(Vec3d((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5) * size);
  mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {1, 0, 2}, {1, 2, 3}, {5, 1, 3}, {5, 3, 7},
                    {0, 4, 6}, {0, 6, 2}, {6, 7, 3}, {6, 3, 2}, {0, 1, 5}, {0, 5, 4}};
  return mesh;
}

}  // namespace

TriangleMesh sphereMesh(double radius, int segments, bool withUv) {
  CHECK(segments >= 4, "segments {}", segments);
  const SphereNet net{segments, segments / 2};
  return withUv ? sphereWithUv(net, radius) : weldedSphere(net, radius);
}

TriangleMesh boxMesh(const Vec3d& size, bool withUv, const Vec2d& uvRepeat) {
  if (!withUv) return weldedBox(size);
  TriangleMesh mesh;
  for (const Face& face : boxFaces(size)) addFace(mesh, face, uvRepeat);
  return mesh;
}

TriangleMesh rectangleMesh(double width, double height, const Vec2d& uvRepeat) {
  TriangleMesh mesh;
  addFace(mesh, {{-width / 2, -height / 2, 0}, {width, 0, 0}, {0, height, 0}}, uvRepeat);
  return mesh;
}

}  // namespace brisance
