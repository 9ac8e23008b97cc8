// Bodies fall and spin (thesis 3.2, Algorithm 4, as corrected by docs/departures.md).
#pragma once

#include "rigid/rigid_bodies.h"
#include "rigid/rigid_settings.h"

namespace brisance {

/// Turns a free body by dt [s] with its angular momentum held exactly (classical Runge-Kutta on the orientation).
void spinFreely(Quaternion& orientation, Vec3d& angularVelocity, const Mat3& inertia, double dt);

/// Positions with the velocities at hand, then gravity, in Algorithm 4's order. `time` [s] is the start of the step.
void stepBodies(RigidBodies& bodies, const RigidSettings& settings, double time, double dt);

}  // namespace brisance
