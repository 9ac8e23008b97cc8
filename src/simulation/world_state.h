// All solvers' state at a moment.
#pragma once

#include <optional>

#include "fluid/fluid_step.h"
#include "fluid/moving_solids.h"
#include "particles/bits.h"
#include "particles/deposit.h"
#include "particles/particle_order.h"
#include "particles/particle_set.h"
#include "rigid/collision_shapes.h"
#include "rigid/rigid_bodies.h"
#include "simulation/world.h"

namespace brisance {

/// A body as the picture knows it; what moves is in RigidBodies under the same number.
struct BodyLook {
  std::string material;
  double temperature = 0;  ///< [K]
  bool moves = true;
  std::optional<double> warmingTime;  ///< [s] as in BodySettings
  bool deforms = false;               ///< its mesh is not the one that it was made with
  bool swelling = false;              ///< gas carries its vertices now
  int shapeFrame = 0;                 ///< frame in which its mesh last changed; 0: at rest
};

/// Sums over the whole run.
struct RunTotals {
  Balance volume, heat;
  double courant = 0, divergence = 0;
  std::int64_t substeps = 0;
};

/// What there is at a moment, without the room that a step works in. It can be copied.
struct WorldMoment {
  int frame = 1;
  bool inFrame = false;       ///< the next frame was begun and has not come to its end
  double time = 0;            ///< [s]
  double largestSource = 0;   ///< phi [1/s] of the last sub-step
  std::uint64_t burning = 0;  ///< particles in that sub-step
  FluidState gas;
  std::optional<StepLimits> limits;  ///< of the gas as it is, where the last sub-step has found them
  ParticleSet particles;
  std::vector<std::uint64_t> emitted;  ///< per charge
  Bits sparks, dust;
  RigidBodies bodies;
  std::vector<CollisionShape> shapes;   ///< of bodies, where they collide
  std::optional<SolidStamper> stamper;  ///< where moving bodies block the gas
  std::vector<BodyLook> looks;
  RunTotals totals;
  StepReport report;          ///< of the last frame
  std::vector<double> burnt;  ///< [kg] per particle in the last sub-step
};

struct WorldState : WorldMoment {
  FluidScratch scratch;
  DepositScratch deposit;
  OrderScratch order;
};

}  // namespace brisance
