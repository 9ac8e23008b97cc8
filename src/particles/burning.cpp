#include "particles/burning.h"

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace brisance {

namespace {
/// How many particles a charge has given by a time.
std::uint64_t dueBy(const Charge& charge, double time) {
  if (time < charge.time) return 0;
  const double emitting = std::min(time - charge.time, charge.emissionTime);
  return static_cast<std::uint64_t>(charge.particles) + static_cast<std::uint64_t>(charge.emissionRate * emitting);
}

/// The cells within reach of a particle.
struct Reach {
  Vec3i lower, upper;  // inclusive
};

class Kernel {
 public:
  Kernel(const Grid3<std::uint8_t>& solid, double radius)
      : solid_(solid), radius_(std::max(radius, solid.cellSize)), inverseSquare_(1 / (radius_ * radius_)) {}

  Reach reach(const Vec3d& place) const {
    const Vec3d p = (place - solid_.origin) / solid_.cellSize;
    const double r = radius_ / solid_.cellSize;
    Reach result;
    for (int axis = 0; axis < 3; ++axis) {
      result.lower[axis] = std::max(0, static_cast<int>(std::ceil(p[axis] - r)));
      result.upper[axis] = std::min(solid_.size[axis] - 1, static_cast<int>(std::floor(p[axis] + r)));
    }
    return result;
  }

  /// Calls visit(cell number, weight) for the cells of one layer k within reach.
  template <class Visit>
  void layer(const Vec3d& place, const Reach& reach, int k, const Visit& visit) const {
    for (int j = reach.lower.y; j <= reach.upper.y; ++j)
      for (int i = reach.lower.x; i <= reach.upper.x; ++i) {
        const Vec3d away = solid_.position(i, j, k) - place;
        const double inside = 1 - dot(away, away) * inverseSquare_;
        const std::int64_t cell = solid_.index(i, j, k);
        if (inside > 0 && !solid_.values[cell]) visit(cell, inside * inside);
      }
  }

  double weightSum(const Vec3d& place, const Reach& r) const {
    double sum = 0;
    for (int k = r.lower.z; k <= r.upper.z; ++k)
      layer(place, r, k, [&](std::int64_t, double weight) { sum += weight; });
    return sum;
  }

 private:
  const Grid3<std::uint8_t>& solid_;
  double radius_, inverseSquare_;
};

struct Deposit {
  Vec3d place;
  Reach reach;
  double perWeight;
};

/// Per layer of cells, the deposits that reach it, in the particles' order.
std::vector<std::vector<std::uint32_t>> byLayer(const std::vector<Deposit>& deposits, int layers) {
  std::vector<std::vector<std::uint32_t>> lists(layers);
  for (std::uint32_t n = 0; n < deposits.size(); ++n)
    for (int k = deposits[n].reach.lower.z; k <= deposits[n].reach.upper.z; ++k) lists[k].push_back(n);
  return lists;
}
}  // namespace

void emitFuel(ParticleSet& particles, const ParticleSettings& settings, double time, double ambient, std::uint64_t seed,
              std::vector<std::uint64_t>& emitted) {
  const Random random(seed, Stream::emission);
  emitted.resize(settings.charges.size(), 0);
  for (std::size_t c = 0; c < settings.charges.size(); ++c) {
    const Charge& charge = settings.charges[c];
    for (const std::uint64_t due = dueBy(charge, time); emitted[c] < due; ++emitted[c]) {
      NewParticle fuel;
      fuel.position = charge.position + random.onSphere(particles.nextId) * charge.radius;
      fuel.mass = settings.burning.mass;
      fuel.ignited = emitted[c] < static_cast<std::uint64_t>(charge.ignited);
      fuel.temperature = fuel.ignited ? settings.burning.ignitionTemperature : ambient;
      append(particles, fuel);
    }
  }
}

void ignite(ParticleSet& particles, const BurnSettings& settings) {
  for (std::size_t n = 0; n < particles.size(); ++n)
    if (particles.kind[n] == ParticleKind::fuel && particles.temperature[n] >= settings.ignitionTemperature)
      particles.ignited[n] = 1;
}

std::vector<double> burn(ParticleSet& particles, const BurnSettings& settings, double dt) {
  std::vector<double> burnt(particles.size(), 0.0);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    if (particles.kind[n] != ParticleKind::fuel || !particles.ignited[n]) continue;
    burnt[n] = std::min(settings.burnRate * dt, particles.mass[n]);
    particles.mass[n] -= burnt[n];
    particles.sootMass[n] += settings.sootPerMass * burnt[n];
  }
  return burnt;
}

void depositBurnt(const ParticleSet& particles, const std::vector<double>& burnt, const BurnSettings& settings,
                  double dt, const Grid3<std::uint8_t>& solid, Grid3<float>& rate) {
  const Kernel kernel(solid, settings.depositRadius);
  std::vector<Deposit> deposits;
  for (std::size_t n = 0; n < burnt.size(); ++n)
    if (burnt[n] > 0) deposits.push_back({particles.position[n], {}, burnt[n]});
  const double perVolume = 1 / (dt * rate.cellSize * rate.cellSize * rate.cellSize);
  parallelFor(0, static_cast<std::int64_t>(deposits.size()), 256, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      Deposit& d = deposits[n];
      d.reach = kernel.reach(d.place);
      const double sum = kernel.weightSum(d.place, d.reach);
      d.perWeight = sum > 0 ? d.perWeight * perVolume / sum : 0;
    }
  });
  const auto lists = byLayer(deposits, rate.size.z);
  parallelFor(0, rate.size.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (const std::uint32_t n : lists[k])
        kernel.layer(deposits[n].place, deposits[n].reach, k, [&](std::int64_t cell, double weight) {
          rate.values[cell] += static_cast<float>(deposits[n].perWeight * weight);
        });
  });
}

double largestDeposit(std::size_t burning, const BurnSettings& settings, double cellSize) {
  // The kernel's peak over its integral, 32 pi R^3 / 105; on a coarse grid no more than all in one cell.
  const double r = std::max(settings.depositRadius, cellSize);
  const double peak = std::min(105 / (32 * pi * r * r * r), 1 / (cellSize * cellSize * cellSize));
  return static_cast<double>(burning) * settings.burnRate * peak;
}

void createSoot(ParticleSet& particles, const BurnSettings& settings, const Grid3<std::uint8_t>& solid,
                std::uint64_t seed) {
  const Random place(seed, Stream::sootPosition), speed(seed, Stream::sootVelocity);
  const auto inGas = [&](const Vec3d& p) {
    const Vec3d cell = (p - solid.origin) / solid.cellSize + Vec3d(.5, .5, .5);
    const int i = static_cast<int>(std::floor(cell.x)), j = static_cast<int>(std::floor(cell.y)),
              k = static_cast<int>(std::floor(cell.z));
    return solid.contains(i, j, k) && !solid(i, j, k);
  };
  const std::size_t parents = particles.size();
  for (std::size_t n = 0; n < parents; ++n) {
    if (particles.kind[n] != ParticleKind::fuel) continue;
    while (particles.sootMass[n] >= settings.sootThreshold && !(settings.sootOnce && particles.madeSoot[n])) {
      const std::uint64_t id = particles.nextId;
      NewParticle soot;
      soot.kind = ParticleKind::soot;
      soot.mass = settings.sootOnce ? particles.sootMass[n] : settings.sootThreshold;
      soot.temperature = particles.temperature[n];
      soot.position = particles.position[n] + place.normal3(id) * settings.sootPositionSpread;
      if (!inGas(soot.position)) soot.position = particles.position[n];
      soot.velocity = particles.velocity[n] * (1 + settings.sootVelocitySpread * speed.normal(id));
      particles.sootMass[n] -= soot.mass;
      particles.madeSoot[n] = 1;
      append(particles, soot);
    }
  }
}

void removeSpent(ParticleSet& particles, const BurnSettings& settings, double dt) {
  std::vector<std::uint8_t> gone(particles.size());
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const bool soot = particles.kind[n] == ParticleKind::soot;
    if (soot) particles.mass[n] -= settings.sootBurnRate * dt;
    gone[n] = particles.mass[n] < (soot ? settings.sootMassThreshold : settings.fuelMassThreshold);
  }
  removeFlagged(particles, gone);
}

std::size_t countBurning(const ParticleSet& particles) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < particles.size(); ++n)
    count += particles.kind[n] == ParticleKind::fuel && particles.ignited[n];
  return count;
}

}  // namespace brisance
