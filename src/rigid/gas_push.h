// Gas pushes and turns bodies by quadratic drag over their surface (thesis 3.2, as corrected by docs/departures.md).
#pragma once

#include "grid/mac_velocity.h"
#include "rigid/rigid_bodies.h"
#include "rigid/rigid_settings.h"

namespace brisance {

/// Changes velocities over dt [s]: force per area F_c |dv| dv, dv the gas' velocity relative to the surface's. Implicit
/// in the body's velocity with |dv| held, which for gas of one velocity is the exact solution and never overshoots.
/// Outside the gas' box nothing pushes. `time` [s]: bodies still held are left alone.
void pushBodies(RigidBodies& bodies, const MacVelocity& gas, const Drag& push, double time, double dt);

}  // namespace brisance
