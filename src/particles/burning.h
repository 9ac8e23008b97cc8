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

/// Burns for dt [s]; `burnt` becomes what each particle burnt: the burning rate times dt, or what it had left. [kg]
void burn(ParticleSet& particles, const BurnSettings& settings, double dt, std::vector<double>& burnt);

/// Soot particles from fuel that has gathered enough, near their parents; a place outside the box or in a solid becomes
/// the parent's.
void createSoot(ParticleSet& particles, const BurnSettings& settings, const Grid3<std::uint8_t>& solid,
                std::uint64_t seed);

/// Fuel and soot below their mass thresholds vanish; soot loses mass at its own burning rate.
void removeSpent(ParticleSet& particles, const BurnSettings& settings, double dt);

std::size_t countBurning(const ParticleSet& particles);

}  // namespace brisance
