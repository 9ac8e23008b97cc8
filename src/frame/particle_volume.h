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

/// `weigh` gives a particle's mass as the picture counts it (0: not drawn); `colourOf` its colour from its temperature
/// [K]; both are called from several threads. Particles outside the volume are not drawn; the filter is narrowed at the
/// volume's faces so that no mass leaves it. Each particle is shared by the eight cell centres around it; the Gaussian
/// is separable.
ParticleVolume splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                              const std::function<float(std::size_t)>& weigh,
                              const std::function<Vec3f(float)>& colourOf);

/// The particles in the order in which they are summed.
struct SplatScratch {
  Binned<SplatPoint<4>> points;
};

/// The same into a volume whose memory is used again, with the scratch memory: much of the time for fresh ones goes
/// into fresh pages.
void splatParticles(const FrameParticles& particles, const ParticleVolumeSettings& settings,
                    const std::function<float(std::size_t)>& weigh, const std::function<Vec3f(float)>& colourOf,
                    ParticleVolume& volume, SplatScratch& scratch);

}  // namespace brisance
