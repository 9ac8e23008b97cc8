// Gas carries and heats particles (thesis 2.4.5, Algorithm 2).
#pragma once

#include <array>

#include "grid/mac_velocity.h"
#include "particles/particle_set.h"
#include "particles/particle_settings.h"

namespace brisance {

/// What particles feel of the gas.
struct GasAround {
  const MacVelocity& velocity;      ///< [m/s]
  const Grid3<float>& temperature;  ///< [K]
  const MacVelocity& openShare;     ///< 0: a face that nothing passes
  std::array<bool, 3> periodic{};   ///< axes along which what leaves comes in again opposite
  bool empty = false;               ///< all faces inside the box are open
};

/// Place and velocity after dt [s] of the drag dv/dt = k |g - v| (g - v) towards gas of velocity g, both exact. k in
/// [1/m].
struct Dragged {
  Vec3d displacement, velocity;
};
Dragged dragExactly(const Vec3d& velocity, const Vec3d& gas, double k, double dt);

/// Moves and heats all particles over dt [s]; those that leave the box vanish, or come in again at a periodic face;
/// walls stop them. Fuel that is then at its ignition temperature burns from now on.
void stepParticles(ParticleSet& particles, const GasAround& gas, const BurnSettings& settings, double dt);

}  // namespace brisance
