// What bodies are to one another when they touch.
#pragma once

#include "mesh/box_tree.h"
#include "mesh/convex_solid.h"
#include "rigid/rigid_bodies.h"

namespace brisance {

/// A triangle of scenery, and how far beyond its edges directions may lean that are its own to push along.
struct SurfaceTriangle {
  ConvexSolid sheet;              ///< in the world
  std::array<Vec3d, 3> outward;   ///< per edge from corner k to the next, in the plane, of length one
  std::array<double, 3> leaning;  ///< sine of the angle to the neighbour's normal; 0: flat or hollow, 1: an open edge
};

/// A body that moves, and convex scenery, is made of convex parts; any other scenery of its triangles.
struct CollisionShape {
  std::vector<ConvexSolid> parts;          ///< about the centre of mass [m]
  std::vector<SurfaceTriangle> triangles;  ///< of scenery, in the world
  std::shared_ptr<const BoxTree> tree;     ///< over the triangles' boxes
  Box3 box;                                ///< of scenery, in the world
  double radius = 0;                       ///< [m] of a sphere about the centre of mass
  double thickness = 0;                    ///< [m] of the thinnest part; of scenery infinite
};

/// Of a body that moves.
CollisionShape movingShape(const TriangleMesh& mesh);
/// One per body. They hold as long as scenery stays in its place and a body keeps its mesh.
std::vector<CollisionShape> collisionShapes(const RigidBodies& bodies);

}  // namespace brisance
