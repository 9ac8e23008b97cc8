// Pieces of one body that still hold together.
//
// A bonded group moves as one. What its members would have done alone, less what they do together, is the load on each;
// bonds carry the loads from piece to piece as elastic beams between their centres would, stiff in proportion to their
// area. A bond comes loose where tension, shear and bending together exceed its strength.
#pragma once

#include <span>

#include "rigid/rigid_bodies.h"

namespace brisance {

/// Impulse on a body, or its change of momentum.
struct Load {
  Vec3d push;   ///< [kg m/s]
  Vec3d twist;  ///< [kg m2/s] about its centre of mass
};

/// Number of the group of each body, 0, 1, 2 ... in order of their first members; a body without bonds is a group.
std::vector<std::uint32_t> bondedGroups(const RigidBodies& bodies);

/// What each bond passes on to its second body, from loads that add up to nothing in every group but for rounding.
/// Bonds that do not hold pass on nothing.
std::vector<Load> bondLoads(const RigidBodies& bodies, std::span<const Load> loads);

enum class Overloaded { worst, all };
/// Loosens bonds that these loads, within `dt` [s], are too much for: all of them, or in each group the worst, whose
/// breaking may relieve the others. Whether there were any.
bool loosenBonds(RigidBodies& bodies, std::span<const Load> loads, double dt, Overloaded which);

}  // namespace brisance
