// Rigid bodies: one array per field.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace brisance {

struct RigidBodies {
  std::vector<std::string> name;
  std::vector<Vec3d> position;  ///< of the centre of mass [m]
  std::vector<Quaternion> orientation;
  std::vector<Vec3d> linearVelocity;                      ///< [m/s]
  std::vector<Vec3d> angularVelocity;                     ///< [1/s], in the world's axes
  std::vector<double> inverseMass;                        ///< [1/kg]; 0: immovable
  std::vector<Mat3> inertia;                              ///< [kg m2] about the centre of mass, in the body's axes
  std::vector<std::shared_ptr<const TriangleMesh>> mesh;  ///< about the centre of mass
  std::vector<double> area;                               ///< [m2] of the surface
  std::vector<double> releaseTime;                        ///< [s] rests in place until then

  std::size_t size() const { return position.size(); }
  /// Moves at this time: neither immovable nor held.
  bool isFree(std::size_t body, double time) const { return inverseMass[body] > 0 && time >= releaseTime[body]; }
};

/// Inertia of a body turned by q, in the world's axes.
Mat3 worldInertia(const Mat3& inertia, const Quaternion& orientation);

}  // namespace brisance
