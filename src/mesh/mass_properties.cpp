#include "mesh/mass_properties.h"

namespace brisance {
namespace {

Mat3 outer(const Vec3d& a, const Vec3d& b) { return {{b * a.x, b * a.y, b * a.z}}; }

/// Moments of a set of simplices, of order 0 (measure), 1 and 2.
struct Moments {
  double measure = 0;
  Vec3d first;
  Mat3 second{{{}, {}, {}}};
};

/// The integral of x x^T over a simplex is measure / (n (n + 1)) times (the sum of p p^T over its n corners, and s s^T
/// of their sum s): n = 3 for a triangle, 4 for the tetrahedron of the triangle and the origin.
void addSimplex(Moments& moments, double measure, const std::array<Vec3d, 3>& p, int corners) {
  const Vec3d sum = p[0] + p[1] + p[2];
  moments.measure += measure;
  moments.first += sum * (measure / corners);
  const Mat3 squares = outer(p[0], p[0]) + outer(p[1], p[1]) + outer(p[2], p[2]) + outer(sum, sum);
  moments.second = moments.second + squares * (measure / (corners * (corners + 1)));
}

double triangleArea(const std::array<Vec3d, 3>& p) { return 0.5 * length(cross(p[1] - p[0], p[2] - p[0])); }
double tetrahedronVolume(const std::array<Vec3d, 3>& p) { return dot(p[0], cross(p[1], p[2])) / 6; }

/// Middle of the bounds. Moments are taken about it: far from the world's origin they would cancel to nothing.
Vec3d middle(const TriangleMesh& mesh) {
  const Box3 box = bounds(mesh);
  return (box.lower + box.upper) * 0.5;
}

std::array<Vec3d, 3> corners(const TriangleMesh& mesh, const Triangle& t, const Vec3d& origin) {
  return {mesh.vertices[t[0]] - origin, mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin};
}

/// `origin` is what the moments were taken about. A body of no measure keeps its inertia about the origin.
MassProperties propertiesOf(const Moments& moments, const Vec3d& origin) {
  MassProperties result;
  const Vec3d shift = moments.measure != 0 ? moments.first / moments.measure : Vec3d{};
  const Mat3 central = moments.second + outer(shift, shift) * -moments.measure;
  const double trace = central.row[0].x + central.row[1].y + central.row[2].z;
  result.volume = moments.measure;
  result.centroid = origin + shift;
  result.inertia = Mat3{} * trace + central * -1;
  return result;
}

}  // namespace

MassProperties solidProperties(const TriangleMesh& mesh) {
  const Vec3d origin = middle(mesh);
  Moments moments;
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto p = corners(mesh, t, origin);
    addSimplex(moments, tetrahedronVolume(p), p, 4);
    area += triangleArea(p);
  }
  MassProperties result = propertiesOf(moments, origin);
  result.area = area;
  return result;
}

MassProperties shellProperties(const TriangleMesh& mesh, double thickness) {
  const Vec3d origin = middle(mesh);
  Moments moments;
  for (const Triangle& t : mesh.triangles) {
    const auto p = corners(mesh, t, origin);
    addSimplex(moments, triangleArea(p), p, 3);
  }
  MassProperties result = propertiesOf(moments, origin);
  result.area = moments.measure;
  result.volume = result.area * thickness;
  result.inertia = result.inertia * thickness;
  return result;
}

}  // namespace brisance
