// Bodies as the contact solver sees them: each on its own, or bonded ones as one.
#pragma once

#include "rigid/contact_solver.h"
#include "rigid/rigid_bodies.h"

namespace brisance {

struct Movers {
  std::vector<Mover> of;
  std::vector<std::uint32_t> number;  ///< per body
};

/// Bodies of one group move as one, with the momentum and angular momentum that its members have together. `group` per
/// body: number of the group, 0, 1, 2 ... in order of their first members. What is not free does not move.
Movers makeMovers(const RigidBodies& bodies, const std::vector<std::uint32_t>& group, const std::vector<bool>& isFree);

/// Mover and members after dt [s]: `fall` is added to the way of each mover [m]; there are as many as movers.
void moveFor(Movers& movers, RigidBodies& bodies, const std::vector<Vec3d>& fall, double dt);
/// Members have the velocities of their movers.
void giveVelocities(const Movers& movers, const std::vector<bool>& isFree, RigidBodies& bodies);

}  // namespace brisance
