#include "rigid/swelling.h"

#include "base/parallel.h"
#include "grid/interpolate.h"
#include "mesh/mass_properties.h"

namespace brisance {

TriangleMesh carriedByGas(TriangleMesh mesh, const Pose& pose, const MacVelocity& gas, double dt) {
  const Quaternion back = conjugate(pose.orientation);
  constexpr std::int64_t grain = 1024;
  parallelFor(0, std::ssize(mesh.vertices), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      const Vec3d place = pose * mesh.vertices[n];
      const Vec3d halfWay = place + interpolate(gas, place) * (dt / 2);
      mesh.vertices[n] += rotate(back, interpolate(gas, halfWay) * dt);
    }
  });
  mesh.normals.clear();  // of the shape that it had
  return mesh;
}

void setHollowShape(RigidBodies& bodies, std::size_t body, TriangleMesh mesh) {
  const MassProperties shell = shellProperties(mesh, 1);
  bodies.inertia[body] = shell.inertia * (1 / (bodies.inverseMass[body] * shell.volume));
  bodies.area[body] = shell.area;
  bodies.mesh[body] = std::make_shared<const TriangleMesh>(std::move(mesh));
}

void stiffen(RigidBodies& bodies, std::size_t body, const MacVelocity& gas) {
  TriangleMesh mesh = *bodies.mesh[body];
  const MassProperties shell = shellProperties(mesh, 1);
  const Pose pose{bodies.position[body], bodies.orientation[body]};
  Vec3d momentum, turning;  // of a mass of 1, over the surface
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const double third = length(cross(b - a, c - a)) / 6 / shell.area;
    for (const Vec3d& middle : {(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0}) {  // exact for velocities linear in place
      const Vec3d velocity = interpolate(gas, pose * middle);
      momentum += velocity * third;
      turning += cross(rotate(pose.orientation, middle - shell.centroid), velocity) * third;
    }
  }
  recenter(mesh, shell.centroid);
  setHollowShape(bodies, body, std::move(mesh));
  bodies.position[body] = pose * shell.centroid;
  bodies.linearVelocity[body] = momentum;
  const Mat3 inertia = worldInertia(bodies.inertia[body], pose.orientation);
  bodies.angularVelocity[body] = inverse(inertia) * (turning * (1 / bodies.inverseMass[body]));
}

}  // namespace brisance
