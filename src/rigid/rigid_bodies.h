// Rigid bodies: one array per field.
#pragma once

#include <compare>
#include <memory>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Numbers of two bodies, the lower first.
struct BodyPair {
  std::uint32_t a = 0, b = 0;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;  // NOLINT(modernize-use-nullptr)
};

/// What one body pressed against another with in the last step: where the next step starts to solve from.
struct PressingForce {
  BodyPair pair;  ///< not ordered: as the contact has them
  Vec3d place;    ///< [m]
  Vec3d force;    ///< on pair.b [N]
};

/// Where two pieces of a body hold together.
struct BodyBond {
  std::uint32_t a = 0, b = 0;
  Vec3d place, normal;  ///< [m] from a's centre of mass, and from a to b; in a's axes
  double area = 0;      ///< [m2]
  double strength = 0;  ///< [Pa]
};

/// How a body lies still.
struct Rest {
  Vec3d place;  ///< of its centre of mass, since it lies still [m]
  Quaternion orientation;
  double duration = 0;     ///< [s]
  std::uint64_t heap = 0;  ///< bodies that fell asleep together have one number; 0: awake
};

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
  std::vector<std::uint32_t> origin;                      ///< which body of the scene it is a piece of
  std::vector<BodyBond> bonds;
  std::vector<std::uint8_t> holds;      ///< per bond; 0: it came loose
  std::vector<BodyPair> passing;        ///< ordered: pass through each other until they come clear
  std::vector<PressingForce> pressing;  ///< in the order of the contacts
  std::vector<Rest> rest;               ///< one each once bodies have met a step in which they can collide

  std::size_t size() const { return position.size(); }
  /// Moves at this time: neither immovable nor held.
  bool isFree(std::size_t body, double time) const { return inverseMass[body] > 0 && time >= releaseTime[body]; }
};

/// Inertia of a body turned by q, in the world's axes.
Mat3 worldInertia(const Mat3& inertia, const Quaternion& orientation);

}  // namespace brisance
