// What has come to rest is left alone until something strikes it.
//
// A heap sleeps when none of its bodies has gone anywhere for half a second: not by speeds, for what is wedged may
// tremble for ever at some centimetres a second, but by places. Bodies that lie on one another fall asleep, and wake,
// together.
#pragma once

#include <span>

#include "rigid/collision_shapes.h"
#include "rigid/movers.h"
#include "rigid/rigid_settings.h"

namespace brisance {

/// Which free bodies are not asleep.
std::vector<bool> awakeBodies(const RigidBodies& bodies, const std::vector<bool>& isFree);

/// Wakes heaps to which something (the gas) gave a speed since the last step that is more than a tenth of what gravity
/// gives in dt [s]; takes it from the others, as the friction would that they lie by.
void wakePushed(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const Vec3d& gravity, double dt);

/// Wakes heaps that awake bodies push harder than by a tenth of what gravity pushes the body in dt [s]. Whether any
/// woke.
bool wakeStruck(RigidBodies& bodies, std::span<const ContactPoint> contacts, const ContactSolver& solver,
                const std::vector<bool>& isAwake, const Vec3d& gravity, double dt);

/// At the end of a step of dt [s]: how long each body has been where it is; heaps that have been for long fall asleep.
void fallAsleep(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const Movers& movers,
                std::span<const ContactPoint> contacts, const ContactSolver& solver, const std::vector<bool>& isAwake,
                double dt);

}  // namespace brisance
