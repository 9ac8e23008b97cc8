#include "render/drawn_volume.h"

#include "render/gas_volume.h"

namespace brisance {
namespace {

/// The mass that the picture counts: fuel that does not burn is not seen.
float drawnMass(const FrameParticles& particles, std::size_t p, float fuelWeight) {
  switch (static_cast<FrameKind>(particles.kind[p])) {
    case FrameKind::burningFuel:
      return particles.mass[p] * fuelWeight;
    case FrameKind::soot:
      return particles.mass[p];
    default:
      return 0;
  }
}

bool volumeOfParticles(const FrameParticles& particles, const VolumeSettings& settings, const BlackbodyColours& heat,
                       ParticleVolume& volume, SplatScratch& scratch) {
  const auto weigh = [&](std::size_t p) { return drawnMass(particles, p, static_cast<float>(settings.fuelWeight)); };
  const auto seen = [&] {
    for (std::size_t p = 0; p < particles.kind.size(); ++p)
      if (weigh(p) > 0) return true;
    return false;
  };
  if (!seen()) return false;
  const ParticleVolumeSettings grid{settings.cells, settings.corner, settings.cellSize, settings.blur,
                                    settings.filterSize};
  splatParticles(particles, grid, weigh, heat, volume, scratch);
  return true;
}

}  // namespace

bool drawnVolume(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat,
                 ParticleVolume& volume, SplatScratch& scratch) {
  if (!settings.drawn) return false;
  if (settings.source == VolumeSource::particles)
    return volumeOfParticles(frame.particles, settings, heat, volume, scratch);
  if (!hasGas(frame.gas)) return false;
  gasVolume(frame.gas, settings, heat, volume);
  return true;
}

}  // namespace brisance
