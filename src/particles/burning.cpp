#include "particles/burning.h"

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
/// How many particles a charge has given by a time.
std::uint64_t dueBy(const Charge& charge, double time) {
  if (time < charge.time) return 0;
  const double emitting = std::min(time - charge.time, charge.emissionTime);
  return static_cast<std::uint64_t>(charge.particles) + static_cast<std::uint64_t>(charge.emissionRate * emitting);
}

constexpr std::int64_t grain = 1 << 14;  // particles per task

/// Calls visit(n) for each of `count` particles, on several threads, in loops over wide vectors: it writes nothing that
/// it reads of other particles, through pointers of its own, since for all the compiler knows a flag's byte may be any.
template <class Visit>
void forEachParticle(std::size_t count, const Visit& visit) {
  parallelFor(0, static_cast<std::int64_t>(count), grain, [&](std::int64_t first, std::int64_t last) {
    runWide([first, last, visit] {
#pragma GCC ivdep
      for (std::int64_t n = first; n < last; ++n) visit(n);
    });
  });
}
}  // namespace

void emitFuel(ParticleSet& particles, const ParticleSettings& settings, double time, double ambient, std::uint64_t seed,
              std::vector<std::uint64_t>& emitted) {
  const Random random(seed, Stream::emission);
  emitted.resize(settings.charges.size(), 0);
  for (std::size_t c = 0; c < settings.charges.size(); ++c) {
    const Charge& charge = settings.charges[c];
    const std::uint64_t due = dueBy(charge, time);
    if (emitted[c] == 0 && due > 0) forEachField(particles, [&](auto& field) { field.reserve(field.size() + due); });
    for (; emitted[c] < due; ++emitted[c]) {
      NewParticle fuel;
      fuel.position = charge.position + random.onSphere(particles.nextId) * charge.radius;
      fuel.mass = settings.burning.mass;
      fuel.ignited = emitted[c] < static_cast<std::uint64_t>(charge.ignited);
      fuel.temperature = fuel.ignited ? settings.burning.ignitionTemperature : ambient;
      append(particles, fuel);
    }
  }
}

void burn(ParticleSet& particles, const BurnSettings& settings, double dt, std::vector<double>& burnt) {
  burnt.resize(particles.size());
  forEachParticle(particles.size(),
                  [kind = particles.kind.data(), ignited = particles.ignited.data(), mass = particles.mass.data(),
                   soot = particles.sootMass.data(), result = burnt.data(), most = settings.burnRate * dt,
                   sootPerMass = settings.sootPerMass](std::int64_t n) {
                    const bool burns = (kind[n] == ParticleKind::fuel) & (ignited[n] != 0);
                    const double burning = std::min(most, mass[n]), now = burns ? burning : 0;
                    result[n] = now;
                    mass[n] -= now;
                    soot[n] += sootPerMass * now;
                  });
}

namespace {
/// Takes soot particles off a fuel particle's gathered soot: calls make(mass) for each.
template <class Make>
void takeSoot(const BurnSettings& settings, double& gathered, std::uint8_t& madeSoot, const Make& make) {
  while (gathered >= settings.sootThreshold && !(settings.sootOnce && madeSoot)) {
    const double mass = settings.sootOnce ? gathered : settings.sootThreshold;
    gathered -= mass;
    madeSoot = 1;
    make(mass);
  }
}

/// Soot particles that a fuel particle is about to make.
std::size_t sootDue(const ParticleSet& particles, const BurnSettings& settings, std::size_t n) {
  std::size_t count = 0;
  if (particles.kind[n] != ParticleKind::fuel || particles.sootMass[n] < settings.sootThreshold) return count;
  double gathered = particles.sootMass[n];
  std::uint8_t madeSoot = particles.madeSoot[n];
  takeSoot(settings, gathered, madeSoot, [&](double) { ++count; });
  return count;
}

/// A fuel particle that makes soot, and where its first soot particle goes.
struct SootParent {
  std::size_t parent, firstSoot;
};

/// Whether a place lies in gas.
bool inGas(const Grid3<std::uint8_t>& solid, const Vec3d& place) {
  const Vec3d cell = (place - solid.origin) / solid.cellSize + Vec3d(.5, .5, .5);
  const int i = static_cast<int>(std::floor(cell.x)), j = static_cast<int>(std::floor(cell.y)),
            k = static_cast<int>(std::floor(cell.z));
  return solid.contains(i, j, k) && !solid(i, j, k);
}

/// Where soot of one id appears, and how fast it is relative to its parent.
struct SootScatter {
  Random place, speed;
  double placeSpread, speedSpread;
};

void makeSoot(ParticleSet& p, const SootScatter& scatter, const Grid3<std::uint8_t>& solid, std::size_t parent,
              std::size_t soot, double mass) {
  const Vec3d place = p.position[parent] + scatter.place.normal3(p.id[soot]) * scatter.placeSpread;
  p.kind[soot] = ParticleKind::soot;
  p.mass[soot] = mass;
  p.temperature[soot] = p.temperature[parent];
  p.position[soot] = inGas(solid, place) ? place : p.position[parent];
  p.velocity[soot] = p.velocity[parent] * (1 + scatter.speedSpread * scatter.speed.normal(p.id[soot]));
}

std::vector<SootParent> sootParents(const ParticleSet& particles, const BurnSettings& settings, std::size_t& soot) {
  std::vector<SootParent> parents;
  soot = 0;
  for (std::size_t n = 0; n < particles.size(); ++n)
    if (const std::size_t count = sootDue(particles, settings, n); count > 0) {
      parents.push_back({n, particles.size() + soot});
      soot += count;
    }
  return parents;
}
}  // namespace

void createSoot(ParticleSet& particles, const BurnSettings& settings, const Grid3<std::uint8_t>& solid,
                std::uint64_t seed) {
  const SootScatter scatter{Random(seed, Stream::sootPosition), Random(seed, Stream::sootVelocity),
                            settings.sootPositionSpread, settings.sootVelocitySpread};
  std::size_t soot = 0;
  const std::vector<SootParent> parents = sootParents(particles, settings, soot);
  appendBlank(particles, soot);
  constexpr std::int64_t parentsPerTask = 256;
  parallelFor(0, static_cast<std::int64_t>(parents.size()), parentsPerTask, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t m = first; m < last; ++m) {
      const std::size_t parent = parents[m].parent;
      std::size_t at = parents[m].firstSoot;
      takeSoot(settings, particles.sootMass[parent], particles.madeSoot[parent],
               [&](double mass) { makeSoot(particles, scatter, solid, parent, at++, mass); });
    }
  });
}

void removeSpent(ParticleSet& particles, const BurnSettings& settings, double dt) {
  std::vector<std::uint8_t> gone(particles.size());
  forEachParticle(particles.size(), [kind = particles.kind.data(), mass = particles.mass.data(), flag = gone.data(),
                                     sootBurnt = settings.sootBurnRate * dt, leastSoot = settings.sootMassThreshold,
                                     leastFuel = settings.fuelMassThreshold](std::int64_t n) {
    const bool soot = kind[n] == ParticleKind::soot;
    const double left = mass[n] - (soot ? sootBurnt : 0), least = soot ? leastSoot : leastFuel;
    mass[n] = left;
    flag[n] = left < least;
  });
  removeFlagged(particles, gone);
}

std::size_t countBurning(const ParticleSet& particles) {
  constexpr std::int64_t blockSize = 1 << 16;
  return static_cast<std::size_t>(
      parallelSum(static_cast<std::int64_t>(particles.size()), blockSize, [&](std::int64_t first, std::int64_t last) {
        std::int64_t count = 0;
        for (std::int64_t n = first; n < last; ++n)
          count += particles.kind[n] == ParticleKind::fuel && particles.ignited[n];
        return static_cast<double>(count);
      }));
}

}  // namespace brisance
