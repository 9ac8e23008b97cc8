// Fuel and soot: one array per field (thesis Table 2.1).
#pragma once

#include <cstdint>
#include <vector>

#include "base/math.h"

namespace brisance {

enum class ParticleKind : std::uint8_t { fuel, soot };

struct ParticleSet {
  std::vector<std::uint64_t> id;    ///< unique for the run: the address of the particle's random numbers
  std::vector<Vec3d> position;      ///< [m]
  std::vector<Vec3d> velocity;      ///< [m/s]
  std::vector<double> mass;         ///< [kg]
  std::vector<double> temperature;  ///< Y [K]
  std::vector<double> sootMass;     ///< s [kg] gathered since the last soot particle
  std::vector<ParticleKind> kind;
  std::vector<std::uint8_t> ignited;
  std::vector<std::uint8_t> madeSoot;
  std::uint64_t nextId = 0;

  std::size_t size() const { return id.size(); }
  friend bool operator==(const ParticleSet&, const ParticleSet&) = default;
};

/// Calls visit(array) for each per-particle array.
template <class Particles, class Visit>
void forEachField(Particles& p, const Visit& visit) {
  visit(p.id);
  visit(p.position);
  visit(p.velocity);
  visit(p.mass);
  visit(p.temperature);
  visit(p.sootMass);
  visit(p.kind);
  visit(p.ignited);
  visit(p.madeSoot);
}

/// Calls visit(array of p, the same array of q) for each per-particle array.
template <class Visit>
void forEachField(ParticleSet& p, ParticleSet& q, const Visit& visit) {
  visit(p.id, q.id);
  visit(p.position, q.position);
  visit(p.velocity, q.velocity);
  visit(p.mass, q.mass);
  visit(p.temperature, q.temperature);
  visit(p.sootMass, q.sootMass);
  visit(p.kind, q.kind);
  visit(p.ignited, q.ignited);
  visit(p.madeSoot, q.madeSoot);
}

/// One particle, to be appended.
struct NewParticle {
  Vec3d position, velocity;
  double mass = 0, temperature = 0;
  ParticleKind kind = ParticleKind::fuel;
  bool ignited = false;
};
void append(ParticleSet& particles, const NewParticle& particle);

/// Appends `count` particles with the next ids, all else zero; returns the place of the first.
std::size_t appendBlank(ParticleSet& particles, std::size_t count);

/// Drops the particles whose flag is set; the others keep their order.
void removeFlagged(ParticleSet& particles, const std::vector<std::uint8_t>& gone);

}  // namespace brisance
