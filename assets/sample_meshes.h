// Meshes that the project makes itself: for tests, benchmarks and the pictures of docs/.
#pragma once

#include "assets/implicit_solid.h"
#include "mesh/triangle_mesh.h"

namespace brisance::samples {

/// Closed, oriented surface of a body inside `box` by surface nets (Gibson 1998): one vertex per cell that the surface
/// crosses, one quadrilateral per lattice edge. The lattice step is `step` [m]. The body must not touch the box.
TriangleMesh surfaceNet(const Implicit& body, const Box3& box, double step);
/// Likewise with about `triangles` triangles.
TriangleMesh surfaceNetOf(const Implicit& body, const Box3& box, long triangles);

/// Bumpy geodesic sphere of radius about 1: 20 n^2 triangles, the count nearest to `triangles`.
TriangleMesh bumpySphere(long triangles);
/// Two bumpy balls of radius 1 and 0.8, joined by a neck of radius 0.18 along x.
TriangleMesh dumbbell(long triangles);
/// A standing figure with head, arms and legs, about 2.3 high, on y = 0 (a toy of clay, for pictures).
TriangleMesh figurine(long triangles);
/// Radii 1 and 0.4, about the z axis.
TriangleMesh torus(long triangles);
/// A sheet of 2 m x 1 m in 2n rows of n cells, open, bent by `degrees` along a fold 0.2 m wide at `foldAt` of its
/// length (thesis Figure 4.4), where it is slightly curved across too: a sheet that is bent one way only has no
/// Gaussian curvature. Flat elsewhere. The fold is off the middle, so that it, and not the outline, says where the
/// sheet is weak. Vertices in rows along the sheet, n + 1 each; the middle of the fold at x = 0.
TriangleMesh foldedSheet(int cells, double degrees, double foldAt = 0.35);

/// Sum of four octaves of smooth lattice noise, from about -2 to 2.
double noise(const Vec3d& p);

}  // namespace brisance::samples
