// Fuel burns: heat, gas and soot (thesis 2.3, Algorithm 2, with rates per second as docs/departures.md says).
#pragma once

#include "grid/grid3.h"
#include "particles/particle_set.h"
#include "particles/particle_settings.h"

namespace brisance {

/// Fuel of all charges that is due by `time`; `emitted` counts what each charge has given so far. New fuel has the
/// ambient temperature [K], rests, and lies at random on its charge's sphere.
void emitFuel(ParticleSet& particles, const ParticleSettings& settings, double time, double ambient, std::uint64_t seed,
              std::vector<std::uint64_t>& emitted);

/// Sets fuel alight that is at its ignition temperature.
void ignite(ParticleSet& particles, const BurnSettings& settings);

/// What each particle burns over dt [s]: the burning rate times dt, or what it has left. [kg]
std::vector<double> burn(ParticleSet& particles, const BurnSettings& settings, double dt);

/// Adds burnt mass / (dt cell volume) [kg/(m3 s)] to `rate`, spread by the kernel (1 - r^2/R^2)^2 over the cells that
/// are not solid: the same size on every grid, so that refining it keeps the explosion. R is at least one cell. The sum
/// over cells is exact to rounding.
void depositBurnt(const ParticleSet& particles, const std::vector<double>& burnt, const BurnSettings& settings,
                  double dt, const Grid3<std::uint8_t>& solid, Grid3<float>& rate);

/// The most that n particles burning in one place can add to a cell of `rate` [kg/(m3 s)].
double largestDeposit(std::size_t burning, const BurnSettings& settings, double cellSize);

/// Soot particles from fuel that has gathered enough, near their parents; a place outside the box or in a solid becomes
/// the parent's.
void createSoot(ParticleSet& particles, const BurnSettings& settings, const Grid3<std::uint8_t>& solid,
                std::uint64_t seed);

/// Fuel and soot below their mass thresholds vanish; soot loses mass at its own burning rate.
void removeSpent(ParticleSet& particles, const BurnSettings& settings, double dt);

std::size_t countBurning(const ParticleSet& particles);

}  // namespace brisance
