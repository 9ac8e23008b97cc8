#include "rigid/gas_push.h"

#include "base/parallel.h"
#include "grid/interpolate.h"

namespace brisance {

namespace {
Mat3 outer(const Vec3d& a, const Vec3d& b) { return {{b * a.x, b * a.y, b * a.z}}; }
Mat3 identity(double s) { return Mat3{} * s; }

/// Where gas acts on a body, in its own axes, and the area it acts on there.
struct SurfacePoint {
  Vec3d arm;
  double area;
};

/// One point per triangle, at its centroid: for a closed flat-sided body the quadrature is exact where the wind is
/// linear over each triangle.
void forSurface(const TriangleMesh& mesh, const AreaQuadrature&, double, const auto& visit) {
  for (const Triangle& t : mesh.triangles) {
    const Vec3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    visit(SurfacePoint{(a + b + c) / 3.0, length(cross(b - a, c - a)) / 2});
  }
}
/// The thesis' choice: every vertex counts alike, as the mean area per vertex of all free bodies.
void forSurface(const TriangleMesh& mesh, const VertexSum&, double areaPerVertex, const auto& visit) {
  for (const Vec3d& v : mesh.vertices) visit(SurfacePoint{v, areaPerVertex});
}

struct MeanArea {
  double perBody = 0, perVertex = 0;
};
MeanArea meanArea(const RigidBodies& bodies, double time) {
  double area = 0, count = 0, vertices = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies.isFree(b, time)) continue;
    area += bodies.area[b];
    count += 1;
    vertices += static_cast<double>(bodies.mesh[b]->vertices.size());
  }
  return {count > 0 ? area / count : 0, vertices > 0 ? area / vertices : 0};
}

/// Force = wind - stiffness v and torque = twist - damping omega, about the centre of mass.
struct SurfaceDrag {
  Vec3d wind, twist;
  Mat3 stiffness = identity(0), damping = identity(0);
};

SurfaceDrag gather(const RigidBodies& bodies, std::size_t b, const MacVelocity& gas, const Drag& push,
                   const MeanArea& mean) {
  const Vec3i n = gas.cells();
  const double h = gas.u.cellSize;
  const Vec3d corner = gas.u.origin - Vec3d(0, .5, .5) * h;
  const Box3 box{corner, corner + Vec3d(n) * h};
  const double favour =
      push.smallPieceFavour == 0 ? 1 : portableExp(push.smallPieceFavour * portableLog(mean.perBody / bodies.area[b]));
  const Mat3 rotation = rotationMatrix(bodies.orientation[b]);
  const Vec3d v = bodies.linearVelocity[b], omega = bodies.angularVelocity[b];
  SurfaceDrag drag;
  const auto act = [&](const SurfacePoint& point) {
    const Vec3d arm = rotation * point.arm, place = bodies.position[b] + arm;
    if (!box.contains(place)) return;
    const Vec3d wind = interpolate(gas, place);
    const double k = push.forceConstant * favour * point.area * length(wind - (v + cross(omega, arm)));
    const double r2 = dot(arm, arm);
    const Mat3 along = push.parallelOnly && r2 > 0 ? outer(arm, arm) * (1 / r2) : identity(1);
    drag.wind += along * wind * k;
    drag.stiffness = drag.stiffness + along * k;
    drag.twist += cross(arm, wind - v) * k;
    drag.damping = drag.damping + (identity(r2) + outer(arm, arm) * -1) * k;
  };
  std::visit([&](const auto& quadrature) { forSurface(*bodies.mesh[b], quadrature, mean.perVertex, act); },
             push.quadrature);
  return drag;
}
}  // namespace

void pushBodies(RigidBodies& bodies, const MacVelocity& gas, const Drag& push, double time, double dt) {
  const MeanArea mean = meanArea(bodies, time);
  parallelFor(0, static_cast<std::int64_t>(bodies.size()), 8, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b) {
      if (!bodies.isFree(b, time)) continue;
      const SurfaceDrag drag = gather(bodies, b, gas, push, mean);
      const double mass = 1 / bodies.inverseMass[b];
      Vec3d& v = bodies.linearVelocity[b];
      v = inverse(identity(mass) + drag.stiffness * dt) * (v * mass + drag.wind * dt);
      const Mat3 inertia = worldInertia(bodies.inertia[b], bodies.orientation[b]);
      Vec3d& omega = bodies.angularVelocity[b];
      omega = inverse(inertia + drag.damping * dt) * (inertia * omega + drag.twist * dt);
    }
  });
}

}  // namespace brisance
