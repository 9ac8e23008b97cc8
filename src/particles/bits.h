// Sparks and dust: bits that fall, that gas drags along, and that do nothing to it.
#pragma once

#include "particles/particle_set.h"
#include "particles/particle_settings.h"
#include "particles/particle_step.h"

namespace brisance {

/// One kind of them. Of each particle only id, place, velocity, mass and temperature mean something.
struct Bits {
  ParticleSet particles;
  std::vector<std::uint8_t> given;  ///< per source, a charge or a body: whether its bits have come
};

/// The sparks of the charges whose time has come: out from the middle, at a third up to all of their speed.
void throwSparks(Bits& sparks, const ParticleSettings& settings, double time, std::uint64_t seed);

/// A grain: a ball of these settings at a place.
void addBit(Bits& bits, const BitSettings& settings, const Vec3d& place, const Vec3d& velocity, double temperature);

/// Lets them fall over dt [s] in the gas that drags them (a ball's drag at high Reynolds numbers) and cools them; walls
/// stop them, and what leaves the box is gone.
void stepBits(Bits& bits, const GasAround& gas, const BitSettings& settings, const Vec3d& gravity, double dt);

}  // namespace brisance
