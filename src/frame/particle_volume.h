// A fine grid of density and colour splatted from the particles and blurred (appendix A.2 of the thesis).
#pragma once

#include <functional>

#include "frame/frame.h"
#include "grid/grid3.h"
#include "grid/splat.h"

namespace brisance {

struct ParticleVolumeSettings {
  Vec3i size{300, 300, 300};
  Vec3d corner;                 ///< [m]
  double cellSize = 1.0 / 300;  ///< [m]
  double blur = 0.02;           ///< alpha [m]: deviation of the Gaussian
  int filterSize = 0;           ///< nf: width of the filter in cells, odd; 0: out to three deviations
};

/// Density is mass per volume [kg/m3]; colour is the density-weighted mean of the particles' colours (A.2: blurred
/// colour over blurred density), zero where there is no density. Both grids cover the box of cells that any particle
/// reaches and a border of empty cells, inside the asked volume: their `origin` (centre of the first cell) and `size`
/// say where it lies, and all beyond is empty. Without particles that is a single empty cell.
struct ParticleVolume {
  Grid3<float> density;
  Grid3<Vec3f> colour;
};

/// What the picture makes of particles; both are called from several threads.
struct ParticleLook {
  /// Masses as the picture counts them, of particles first .. first + count - 1; 0: not drawn.
  std::function<void(std::int64_t first, int count, float* masses)> weigh;
  /// Colours of so many temperatures [K].
  std::function<void(const float* temperatures, int count, Vec3f* colours)> colour;
};
/// From what `weigh(n)` gives for particle n and `colourOf(temperature)`, which must live as long.
template <class Weigh, class ColourOf>
ParticleLook lookOf(const Weigh& weigh, const ColourOf& colourOf) {
  return {[&weigh](std::int64_t first, int count, float* masses) {
            for (int n = 0; n < count; ++n) masses[n] = weigh(static_cast<std::size_t>(first + n));
          },
          [&colourOf](const float* temperatures, int count, Vec3f* colours) {
            for (int n = 0; n < count; ++n) colours[n] = colourOf(temperatures[n]);
          }};
}

/// What is kept for the next volume: the particles in the order in which they are summed, and how far they reach.
struct SplatScratch {
  Binned<SplatPoint<4>> points;
  std::vector<CellSpan> reachAlongX;  ///< per run of particles
};

/// Particles outside the volume are not drawn; the filter is narrowed at the volume's faces so that no mass leaves it.
/// Each particle is shared by the eight cell centres around it; the Gaussian is separable. The volume's memory is used
/// again, and the scratch memory: much of the time for fresh ones goes into fresh pages.
void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings, const ParticleLook& look,
                    ParticleVolume& volume, SplatScratch& scratch);

template <class Weigh, class ColourOf>
void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings, const Weigh& weigh,
                    const ColourOf& colourOf, ParticleVolume& volume, SplatScratch& scratch) {
  splatParticles(particles, settings, lookOf(weigh, colourOf), volume, scratch);
}
template <class Weigh, class ColourOf>
ParticleVolume splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                              const Weigh& weigh, const ColourOf& colourOf) {
  ParticleVolume volume;
  SplatScratch scratch;
  splatParticles(particles, settings, weigh, colourOf, volume, scratch);
  return volume;
}

}  // namespace brisance
