#include "rigid/rigid_step.h"

namespace brisance {

Mat3 worldInertia(const Mat3& inertia, const Quaternion& orientation) {
  const Mat3 r = rotationMatrix(orientation);
  return r * inertia * transpose(r);
}

namespace {
Quaternion plus(const Quaternion& a, const Quaternion& b, double s) {
  return {a.w + s * b.w, a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// dq/dt = omega q / 2 with omega from the held angular momentum.
Quaternion turning(const Quaternion& q, const Mat3& inverseInertia, const Vec3d& momentum) {
  const Quaternion unit = normalized(q);
  const Vec3d omega = rotate(unit, inverseInertia * rotate(conjugate(unit), momentum));
  return plus({0, 0, 0, 0}, Quaternion{0, omega.x, omega.y, omega.z} * q, 0.5);
}
}  // namespace

void spinFreely(Quaternion& orientation, Vec3d& angularVelocity, const Mat3& inertia, double dt) {
  if (angularVelocity == Vec3d{}) return;
  const Vec3d momentum = worldInertia(inertia, orientation) * angularVelocity;
  const Mat3 inverseInertia = inverse(inertia);
  const Quaternion& q = orientation;
  const Quaternion k1 = turning(q, inverseInertia, momentum),
                   k2 = turning(plus(q, k1, dt / 2), inverseInertia, momentum),
                   k3 = turning(plus(q, k2, dt / 2), inverseInertia, momentum),
                   k4 = turning(plus(q, k3, dt), inverseInertia, momentum);
  orientation = normalized(plus(plus(plus(plus(q, k1, dt / 6), k2, dt / 3), k3, dt / 3), k4, dt / 6));
  angularVelocity = rotate(orientation, inverseInertia * rotate(conjugate(orientation), momentum));
}

void stepBodies(RigidBodies& bodies, const RigidSettings& settings, double time, double dt) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies.isFree(b, time)) continue;
    bodies.position[b] += bodies.linearVelocity[b] * dt + settings.gravity * (dt * dt / 2);
    spinFreely(bodies.orientation[b], bodies.angularVelocity[b], bodies.inertia[b], dt);
    bodies.linearVelocity[b] += settings.gravity * dt;
  }
}

}  // namespace brisance
