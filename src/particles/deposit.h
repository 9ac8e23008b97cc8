// What burns becomes a rate on the grid, over a kernel of fixed physical size.
#pragma once

#include "grid/grid3.h"
#include "grid/splat.h"
#include "particles/particle_set.h"
#include "particles/particle_settings.h"

namespace brisance {

/// Memory that deposits use again, and what they keep while the solids stay as they are.
struct DepositScratch {
  Binned<SplatPoint<1>> points;
  Grid3<std::uint8_t> solid;  ///< the solids that `perSource` was made for
  double kernelCells = 0;     ///< the radius that it was made for
  Grid3<float> perSource;     ///< one over the share of a cell's kernel that falls on gas
};

/// Sets `rate` to the burnt mass / (dt cell volume) [kg/(m3 s)], spread over the cells that are not solid by a kernel
/// of the same size on every grid, so that refining it keeps the explosion: a particle is shared by the eight cells
/// around it, and its shares spread by (1 - x^2/R^2)^3 along each axis, R chosen so that the whole has the deviation
/// depositRadius / 3 along each axis (with cells wider than 0.8 depositRadius, the sharing alone has more). The sum
/// over cells is exact to rounding.
void depositBurnt(const ParticleSet& particles, const std::vector<double>& burnt, const BurnSettings& settings,
                  double dt, const Grid3<std::uint8_t>& solid, Grid3<float>& rate, DepositScratch& scratch);

/// The most that n particles burning in one place can add to a cell of `rate` [kg/(m3 s)], away from walls.
double largestDeposit(std::size_t burning, const BurnSettings& settings, double cellSize);

}  // namespace brisance
