// Which bodies touch, and where.
#pragma once

#include <span>

#include "rigid/contact_manifold.h"

namespace brisance {

/// Pairs whose boxes, grown by `reach` [m] per body, meet; ordered; at least one of each is free.
std::vector<BodyPair> nearPairs(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                                std::span<const double> reach, const std::vector<bool>& isFree);

/// Contacts of each pair that are closer than the pair's reach [m], in the order of the pairs.
std::vector<std::vector<ContactPoint>> contactsOf(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                                                  std::span<const BodyPair> pairs, std::span<const double> reach);

/// Pairs that touch as a body's neighbouring pieces do, or overlap, at the start: they pass through each other until
/// they have come clear.
std::vector<BodyPair> passingPairs(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes);
/// Forgets pairs that have come clear. Pairs of which neither is free are left alone.
void forgetPassed(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const std::vector<bool>& isFree);

}  // namespace brisance
