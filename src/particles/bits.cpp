#include "particles/bits.h"

#include <cmath>

#include "base/random.h"

namespace brisance {

namespace {
double massOf(const BitSettings& s) { return 4.0 / 3 * pi * s.radius * s.radius * s.radius * s.density; }

/// What stepParticles() makes of it: the drag force is `drag` radius^2 |dv| dv; temperatures part to 1/e in
/// `coolingTime`.
BurnSettings asParticles(const BitSettings& s) {
  constexpr double dragOfBall = 0.45, airDensity = 1.2;  // [kg/m3]
  BurnSettings particles;
  particles.radius = s.radius;
  particles.drag = 0.5 * dragOfBall * airDensity * pi;
  particles.fuelMassThreshold = particles.sootMassThreshold = 0;
  particles.thermalMass = s.coolingTime;
  particles.thermalMassThreshold = 0;
  particles.heating = 1 / (s.radius * s.radius);
  return particles;
}
}  // namespace

void addBit(Bits& bits, const BitSettings& settings, const Vec3d& place, const Vec3d& velocity, double temperature) {
  NewParticle bit;
  bit.position = place;
  bit.velocity = velocity;
  bit.mass = massOf(settings);
  bit.temperature = temperature;
  bit.kind = ParticleKind::soot;
  append(bits.particles, bit);
}

void throwSparks(Bits& sparks, const ParticleSettings& settings, double time, std::uint64_t seed) {
  const Random way(seed, Stream::sparkWay), speed(seed, Stream::sparkSpeed);
  sparks.given.resize(settings.charges.size(), 0);
  for (std::size_t c = 0; c < settings.charges.size(); ++c) {
    const Charge& charge = settings.charges[c];
    if (sparks.given[c] || time < charge.time) continue;
    sparks.given[c] = 1;
    for (int n = 0; n < charge.sparks; ++n) {
      const std::uint64_t id = sparks.particles.nextId;
      const Vec3d out = way.onSphere(id);
      const double share = (1 + 2 * speed.uniform(id)) / 3;
      addBit(sparks, settings.sparks, charge.position + out * (charge.radius * share),
             out * (charge.sparkSpeed * share), charge.sparkTemperature);
    }
  }
}

void stepBits(Bits& bits, const GasAround& gas, const BitSettings& settings, const Vec3d& gravity, double dt) {
  if (bits.particles.size() == 0) return;
  for (Vec3d& velocity : bits.particles.velocity) velocity = velocity + gravity * dt;
  stepParticles(bits.particles, gas, asParticles(settings), dt);
}

}  // namespace brisance
