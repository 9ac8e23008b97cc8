// What moves bodies.
#pragma once

#include <variant>

#include "base/math.h"

namespace brisance {

/// How the force of the gas is summed over a body.
struct AreaQuadrature {};  ///< per area of the surface: a finer mesh is pushed the same
struct VertexSum {};       ///< the thesis' choice: per vertex, so small pieces fly faster
using PushQuadrature = std::variant<AreaQuadrature, VertexSum>;

/// The thesis' choice: by the gas' velocity over the surface.
struct Drag {
  double forceConstant = 1.0;  ///< F_c [kg/m3]: force per area = F_c |dv| dv
  PushQuadrature quadrature;
  bool parallelOnly = false;    ///< the thesis' choice: only the force along r accelerates the centre of mass
  double smallPieceFavour = 0;  ///< force times (mean area / area)^this: the "small ones faster" look
};

/// By the pressure of the gas that bodies block, as it is solved for (fluid/body_push.h).
struct Pressure {};
using GasPush = std::variant<Drag, Pressure>;

/// Bodies pass through one another, as in the thesis.
struct NoCollisions {};
/// Bodies stop one another (collide.h).
struct Contacts {
  double friction = 0.6;     ///< Coulomb's coefficient
  double restitution = 0.2;  ///< speed of parting over speed of meeting
};
using Collisions = std::variant<NoCollisions, Contacts>;

struct RigidSettings {
  Vec3d gravity{0, -9.81, 0};  ///< [m/s2]
  GasPush push;
  Collisions collisions;
};

}  // namespace brisance
