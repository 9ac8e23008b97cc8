// What inertia a shape has.
#pragma once

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Of a body of density 1: multiply volume, and inertia, by the density [kg/m3].
struct MassProperties {
  double volume = 0;  ///< [m3]
  double area = 0;    ///< [m2] of the surface
  Vec3d centroid;     ///< [m]
  Mat3 inertia;       ///< [m5] about the centroid
};

/// Exact for a closed, oriented polyhedron (the integrals of Eberly 2002, "Polyhedral mass properties", summed over
/// signed tetrahedra). A mesh turned inside out has a negative volume and inertia.
MassProperties solidProperties(const TriangleMesh& mesh);
/// Of an open shell of the given thickness [m]: the surface integral, for a shell much thinner than it is wide.
MassProperties shellProperties(const TriangleMesh& mesh, double thickness);

}  // namespace brisance
