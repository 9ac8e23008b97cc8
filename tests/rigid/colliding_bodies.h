// Bodies made by hand, to be stepped with collisions.
#pragma once

#include "mesh/mass_properties.h"
#include "mesh/shapes.h"
#include "rigid/collide.h"
#include "rigid/contacts.h"
#include "rigid/rigid_step.h"

namespace brisance::test {

inline void addBody(RigidBodies& bodies, const TriangleMesh& mesh, const Pose& pose, double density = 1000) {
  const MassProperties m = solidProperties(mesh);
  bodies.name.push_back("body" + std::to_string(bodies.size()));
  bodies.position.push_back(pose.position);
  bodies.orientation.push_back(pose.orientation);
  bodies.linearVelocity.emplace_back();
  bodies.angularVelocity.emplace_back();
  bodies.inverseMass.push_back(density > 0 ? 1 / (m.volume * density) : 0);
  bodies.inertia.push_back(m.inertia * density);
  bodies.mesh.push_back(std::make_shared<const TriangleMesh>(mesh));
  bodies.area.push_back(m.area);
  bodies.releaseTime.push_back(0);
  bodies.origin.push_back(static_cast<std::uint32_t>(bodies.origin.size()));
}
inline void addBox(RigidBodies& bodies, const Vec3d& size, const Pose& pose, double density = 1000) {
  addBody(bodies, boxMesh(size, false), pose, density);
}
/// Scenery from y = -1 to 0.
inline void addFloor(RigidBodies& bodies) { addBox(bodies, {40, 1, 40}, {{0, -.5, 0}, {}}, 0); }

/// Bodies with their shapes, stepped at a fixed rate.
struct Bench {
  explicit Bench(RigidBodies made) : bodies(std::move(made)), shapes(collisionShapes(bodies)) {
    bodies.passing = passingPairs(bodies, shapes);
    settings.collisions = Contacts{};
  }
  void step() {
    stepColliding(bodies, shapes, settings, time, dt);
    time += dt;
  }
  void run(double seconds) {
    for (const double end = time + seconds - dt / 2; time < end;) step();
  }
  RigidBodies bodies;
  std::vector<CollisionShape> shapes;
  RigidSettings settings;
  double time = 0, dt = 1. / 240;
};

inline double kineticEnergy(const RigidBodies& b) {
  double energy = 0;
  for (std::size_t n = 0; n < b.size(); ++n) {
    if (b.inverseMass[n] == 0) continue;
    const Vec3d spin = b.angularVelocity[n];
    energy += dot(b.linearVelocity[n], b.linearVelocity[n]) / b.inverseMass[n] / 2;
    energy += dot(spin, worldInertia(b.inertia[n], b.orientation[n]) * spin) / 2;
  }
  return energy;
}
inline Vec3d momentum(const RigidBodies& b) {
  Vec3d sum;
  for (std::size_t n = 0; n < b.size(); ++n)
    if (b.inverseMass[n] > 0) sum += b.linearVelocity[n] / b.inverseMass[n];
  return sum;
}
/// About the origin.
inline Vec3d angularMomentum(const RigidBodies& b) {
  Vec3d sum;
  for (std::size_t n = 0; n < b.size(); ++n)
    if (b.inverseMass[n] > 0)
      sum += cross(b.position[n], b.linearVelocity[n] / b.inverseMass[n]) +
             worldInertia(b.inertia[n], b.orientation[n]) * b.angularVelocity[n];
  return sum;
}
/// Height of the lowest vertex [m].
inline double lowest(const RigidBodies& b, std::size_t n) {
  double least = 1e300;
  for (const Vec3d& v : b.mesh[n]->vertices) least = std::min(least, (Pose{b.position[n], b.orientation[n]} * v).y);
  return least;
}

}  // namespace brisance::test
