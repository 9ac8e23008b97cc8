// What gas may know of a body.
#pragma once

#include <memory>

#include "mesh/triangle_mesh.h"

namespace brisance {

struct MovingSolid {
  std::shared_ptr<const TriangleMesh> mesh;  ///< about its own origin
  Pose pose;
  Vec3d velocity;                      ///< [m/s] of the origin
  Vec3d angularVelocity;               ///< [1/s]
  double inverseMass = 0;              ///< [1/kg]; 0: nothing that gas does changes its velocity
  Mat3 inverseInertia = Mat3{} * 0.0;  ///< [1/(kg m2)] about the origin, in the world's axes

  Vec3d velocityAt(const Vec3d& place) const { return velocity + cross(angularVelocity, place - pose.position); }
};

}  // namespace brisance
