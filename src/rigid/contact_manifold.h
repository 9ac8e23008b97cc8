// Where two convex solids touch, or may touch soon.
#pragma once

#include <cstdint>
#include <vector>

#include "rigid/collision_shapes.h"

namespace brisance {

struct ContactPoint {
  std::uint32_t a = 0, b = 0;  ///< bodies
  Vec3d place;                 ///< [m] midway between the surfaces
  Vec3d normal;                ///< from a to b
  double gap = 0;              ///< [m]; below zero: overlap
};

/// Contacts closer than `reach` [m] between placed solids; faces meet in the corners of what they share.
void touch(const ConvexSolid& a, const ConvexSolid& b, double reach, std::vector<ContactPoint>& contacts);
/// Likewise of scenery `a`: pushes only along directions that are this triangle's own, so that no body stumbles over
/// the edges between triangles.
void touch(const SurfaceTriangle& a, const ConvexSolid& b, double reach, std::vector<ContactPoint>& contacts);

/// Of contacts with nearly one normal: the deepest and those farthest out, which hold a body as all of them would.
void reduceContacts(std::vector<ContactPoint>& contacts);

}  // namespace brisance
