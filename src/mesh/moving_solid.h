// What gas may know of a body.
#pragma once

#include <memory>

#include "mesh/triangle_mesh.h"

namespace brisance {

struct MovingSolid {
  std::shared_ptr<const TriangleMesh> mesh;  ///< about its own origin
  Pose pose;
  Vec3d velocity;         ///< [m/s] of the origin
  Vec3d angularVelocity;  ///< [1/s]
};

}  // namespace brisance
