#include "particles/particle_set.h"

namespace brisance {

void append(ParticleSet& p, const NewParticle& particle) {
  p.id.push_back(p.nextId++);
  p.position.push_back(particle.position);
  p.velocity.push_back(particle.velocity);
  p.mass.push_back(particle.mass);
  p.temperature.push_back(particle.temperature);
  p.sootMass.push_back(0);
  p.kind.push_back(particle.kind);
  p.ignited.push_back(particle.ignited);
  p.madeSoot.push_back(0);
}

void removeFlagged(ParticleSet& particles, const std::vector<std::uint8_t>& gone) {
  forEachField(particles, [&](auto& field) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < field.size(); ++n)
      if (!gone[n]) field[kept++] = field[n];
    field.resize(kept);
  });
}

}  // namespace brisance
