// What the gas may be told.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Weighted sum of central and upwind differences (thesis 2.4.2; Griebel, Dornseifer & Neunhoeffer 1998, eq. 3.19).
struct DonorCell {
  double upwindWeight = 1.0;  ///< 0 central .. 1 upwind
  friend bool operator==(const DonorCell&, const DonorCell&) = default;
};
/// A donor-cell step forward, one back, and half of what differs then taken off: second order in space and time (Selle,
/// Fedkiw, Kim, Liu & Rossignac 2008, on the steps of MacCormack 1969).
struct MacCormack {
  bool clamped = true;  ///< to the values that the cell and its neighbours had: no new extrema
  friend bool operator==(const MacCormack&, const MacCormack&) = default;
};
/// Each sample takes the value whence the flow brought it (Stam 1999): steps of any length, and soft.
struct SemiLagrangian {
  friend bool operator==(const SemiLagrangian&, const SemiLagrangian&) = default;
};
using AdvectionScheme = std::variant<DonorCell, MacCormack, SemiLagrangian>;

/// Whichever of the solvers below suits the solids in the gas.
struct AutomaticSolver {
  double tolerance = 1e-4;  ///< of the final velocity's divergence, as below
  int patience = 100;       ///< iterations of fast_poisson among solids before multigrid goes on from there
  friend bool operator==(const AutomaticSolver&, const AutomaticSolver&) = default;
};

/// Directly by trigonometric transforms where the box is empty; with solids, conjugate gradients preconditioned by
/// that. The tolerance is that of the divergence of the final velocity, relative to the one there was to remove, and
/// the velocity is corrected until it holds (or until velocities in single precision cannot hold it better).
struct FastPoisson {
  double tolerance = 1e-4;
  int maxIterations = 200;
  friend bool operator==(const FastPoisson&, const FastPoisson&) = default;
};

/// Conjugate gradients preconditioned by geometric multigrid, for solids of much surface; tolerance as above.
struct MultigridSolver {
  double tolerance = 1e-4;
  int maxIterations = 200;
  friend bool operator==(const MultigridSolver&, const MultigridSolver&) = default;
};

/// Thesis Algorithm 1, corrected, in double precision, to a residual relative to the right-hand side.
struct ConjugateGradient {
  double tolerance = 1e-6;
  int maxIterations = 4000;
  friend bool operator==(const ConjugateGradient&, const ConjugateGradient&) = default;
};
using PressureSolver = std::variant<AutomaticSolver, FastPoisson, MultigridSolver, ConjugateGradient>;

/// open: p = 0 on the face, the gas flows through. no_slip, free_slip: a wall. periodic: the gas comes in again at the
/// opposite face, which is periodic too.
enum class FaceKind { open, noSlip, freeSlip, periodic };
/// Order of faces everywhere: x lower, x upper, y lower, y upper, z lower, z upper.
using Faces = std::array<FaceKind, 6>;
/// Numbers of the two faces across an axis.
constexpr std::size_t lowerFaceOf(int axis) { return std::size_t{2} * axis; }
constexpr std::size_t upperFaceOf(int axis) { return lowerFaceOf(axis) + 1; }
constexpr bool isPeriodic(const Faces& faces, int axis) { return faces[lowerFaceOf(axis)] == FaceKind::periodic; }

/// Keeps the gas of a cylinder turning about its axis like a solid, as a spoon keeps water (thesis Figure 5.1).
struct Stirring {
  Vec3d centre;                  ///< [m] on the axis, half-way along the cylinder
  Vec3d axis{0, 1, 0};           ///< of rotation, of any length; counter-clockwise seen from its tip
  double radius = 0.5;           ///< [m]
  std::optional<double> length;  ///< [m] of the cylinder; none: through the whole box
  double angularSpeed = 1;       ///< [rad/s]
  double relaxation = 0.05;      ///< [s] in which gas comes up to speed to 1/e
  friend bool operator==(const Stirring&, const Stirring&) = default;
};

struct FluidSettings {
  Vec3i cells{64, 64, 64};
  Vec3d corner;                         ///< [m] lower corner of the box
  double cellSize = 1.0 / 64;           ///< [m]
  Faces faces{};                        ///< all open
  std::array<Vec3d, 6> wallVelocity{};  ///< [m/s] of no-slip faces along themselves
  bool removeMeanSource = false;        ///< a sealed space and a net source in it: let the mean go, instead of refusing

  AdvectionScheme advection;
  PressureSolver pressure;

  double viscosity = 0;              ///< [m2/s] (1/Re of the thesis)
  double conductivity = 0;           ///< c_k [m2/s]
  double coolingRate = 2500;         ///< c_r [K/s] at the maximum temperature
  double ambientTemperature = 300;   ///< T_a [K]
  double maximumTemperature = 2675;  ///< T_max [K], the scale of the cooling term
  double heatCapacity = 1200;        ///< rho c_p [J/(m3 K)]
  double density = 1.2;              ///< rho [kg/m3] of the gas whose pressure pushes bodies
  Vec3d force;                       ///< g_x, g_y, g_z on the gas [m/s2]
  double buoyancy = 0;               ///< upward (+y) acceleration per kelvin above ambient [m/(s2 K)]
  double vorticityConfinement = 0;   ///< epsilon of Fedkiw, Stam & Jensen 2001, dimensionless
  double flameLifetime = 0.15;       ///< [s] over which the flame field fades to 1/e
  Vec3d wind;                        ///< [m/s] of the air outside and, at first, inside
  std::vector<Stirring> stirring;
  double startVelocity = 0;   ///< [m/s] deviation of the random start velocities (thesis 2.4.3)
  double courant = 1.0;       ///< dt sum(|u_i|)/dx stays below, in every cell
  double maxSubsteps = 2000;  ///< per frame, beyond which the run stops as unstable
};

}  // namespace brisance
