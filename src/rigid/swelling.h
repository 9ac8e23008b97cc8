// A body that swells like a balloon before it bursts: gas carries its vertices, as it carries particles (thesis 5.1,
// Figure 5.7), until it is released in rigid pieces.
#pragma once

#include "grid/mac_velocity.h"
#include "rigid/rigid_bodies.h"

namespace brisance {

/// Moves the mesh's vertices over dt [s] with the gas (the midpoint rule); `pose` tells where the mesh lies.
TriangleMesh carriedByGas(TriangleMesh mesh, const Pose& pose, const MacVelocity& gas, double dt);

/// Makes a piece rigid in the shape that it has, hollow: its mesh about its centroid, the inertia of a shell of its
/// mass, and the linear and angular momentum that its surface has where the gas carries it.
void stiffen(RigidBodies& bodies, std::size_t body, const MacVelocity& gas);

/// Gives a piece the mesh, which lies about its centroid, and what follows from it for a shell of the piece's mass.
void setHollowShape(RigidBodies& bodies, std::size_t body, TriangleMesh mesh);

}  // namespace brisance
