// Bodies fall, spin, and stop one another.
#pragma once

#include "rigid/collision_shapes.h"
#include "rigid/rigid_settings.h"

namespace brisance {

/// One step of dt [s], in as many parts as the thinnest and fastest body near another one asks for. Contacts are found
/// anew in each part, from poses and velocities alone: nothing is kept from part to part but what is in `bodies`.
/// `time` [s] is the start of the step; bodies that are held until later stand like scenery. Bonded bodies move as one
/// (bonds.h), also where settings say that bodies do not collide.
void stepColliding(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const RigidSettings& settings,
                   double time, double dt);

}  // namespace brisance
