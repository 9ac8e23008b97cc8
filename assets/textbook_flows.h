// Flows whose solution is known, run by the project's own solver: for tests and for the figures of docs/gas.md.
#pragma once

#include <span>
#include <vector>

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance::textbook {

/// Taylor and Green's vortex (1937) in a periodic unit square, carried along by a wind.
struct Vortex {
  int cells = 32;
  AdvectionScheme scheme;
  double viscosity = 0.01;  ///< [m2/s]
  Vec3d wind;               ///< [m/s]
  double time = 0.2;        ///< [s]
  int steps = 100;
};
/// Against the exact solution at the end.
struct VortexResult {
  double decay = 0;         ///< root of the energy that is left, relative to the exact
  double meanError = 0;     ///< [m/s] of u
  double largestError = 0;  ///< [m/s]
};
VortexResult runVortex(const Vortex& vortex);

/// Gas in a box whose lid, y = 1, moves at 1 m/s along x.
struct Cavity {
  int cells = 64;
  AdvectionScheme scheme;
  double reynolds = 100;
  double courant = 1;
  double longestTime = 60;  ///< [s]
};
struct CavityProfiles {
  std::vector<Vec2d> u;  ///< (y, u) at x = 1/2, from wall to wall
  std::vector<Vec2d> v;  ///< (x, v) at y = 1/2
  int steps = 0;
  double time = 0;    ///< [s] until nothing changed any more
  double change = 0;  ///< [m/s2] of the fastest change then
};
CavityProfiles runCavity(const Cavity& cavity);

/// Tables I and II of Ghia, Ghia & Shin 1982, without their walls. Their v at x = 0.9063 for Re = 400, -0.23827, is
/// left out: it lies far off the curve through its neighbours, a slip of the print.
struct GhiaTable {
  std::span<const Vec2d> u, v;
};
GhiaTable ghia(int reynolds);  ///< 100 or 400

/// The value at a place, linear between points.
double along(std::span<const Vec2d> profile, double place);
/// Largest distance of a profile from the points of a table.
double farthest(std::span<const Vec2d> profile, std::span<const Vec2d> table);

/// Largest error [m/s] of the gradient of a known pressure on n^3 cells with open faces.
double poissonError(int cells);

}  // namespace brisance::textbook
