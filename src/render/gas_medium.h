// The gas as light passes it (appendix A.2): the particles' volume marched from front to back.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "frame/particle_volume.h"
#include "render/gas_bricks.h"
#include "render/render_settings.h"

namespace brisance {

/// A straight way through the gas, in metres from `origin` along the unit `direction`.
struct GasPath {
  Vec3f origin, direction;
  float near, far;
  float phase = 0.5f;  ///< 0 .. 1: where in a step the samples lie, different for each pixel so that no bands are seen
};

/// What comes out of a way's near end: the gas' own light, and the share of what lies behind.
struct GasPassage {
  Vec3f light;
  float transmittance = 1;
};

/// How opaque gas of a density is, and how bright.
class GasOptics {
 public:
  explicit GasOptics(const VolumeSettings& settings);
  /// Opacity per metre, kappa = tau d with d = min_d + (max_d - min_d) min(1, density / fullDensity). The part min_d
  /// fades in over the first hundredth of the range, so that thin gas has no rim. [1/m]
  float extinction(float density) const {
    const float share = std::min(std::max(density * perFullDensity_, 0.0f), 1.0f);
    const float t = std::min(share * perFadeIn, 1.0f);
    return opacity_ * (minDensity_ * (t * t * (3 - 2 * t)) + densityRange_ * share);
  }
  /// What fully opaque gas of a blackbody colour gives off itself: part of I in equation A.4.
  Vec3f glow(const Vec3f& colour) const { return colour * emission_; }
  /// The other part: what it scatters of light of that radiance from all around.
  Vec3f scattered(const Vec3f& around) const { return smokeColour_ * around; }

 private:
  static constexpr float perFadeIn = 100;  ///< 1 / the share of the density range over which min_d fades in
  float opacity_, minDensity_, densityRange_, perFullDensity_, emission_;
  Vec3f smokeColour_;
};

struct LightSource;
struct GasSteps;
struct GasWays;
struct GasWaySteps;
class NumberRun;

/// A volume and a coarse grid of blocks over it, by which rays skip the empty parts.
class GasMedium {
 public:
  static constexpr int blockCells = GasBrick::cells;  ///< along each edge of a block
  static constexpr int blockBits = 3;                 ///< log2 of that
  static constexpr int packet = 16;                   ///< ways that are marched side by side

  /// Copies the volume, into `memory` where that is large enough.
  GasMedium(const ParticleVolume& volume, const VolumeSettings& settings, BrickMemory memory = {});
  /// The memory of a medium that is no longer needed.
  static BrickMemory memoryOf(GasMedium&& gas) { return std::move(gas.memory_); }

  /// What each block scatters, once and alike in all directions: light of the surroundings as much as the gas on six
  /// sides lets through, and what lights send through the gas before it. Bodies do not shade the gas. To be called at
  /// most once; before it, gas scatters none.
  void illuminate(const Vec3f& ambientLight, const std::vector<LightSource>& lights);

  /// Light and opacity added up from front to back (equations A.3 and A.4), ended where the opacity exceeds 0.999:
  /// what lies behind then counts as nothing.
  GasPassage march(const GasPath& path) const;
  /// The same for some ways at once, up to rounding: `packet` of them side by side in the lanes of vectors.
  void march(std::span<const GasPath> paths, std::span<GasPassage> passages) const;
  /// The share of light that passes, from the mean of each block alone: for shadows.
  float roughTransmittance(const GasPath& path) const;

  // What the path integrator asks. It never calls illuminate(): gas then gives off its own light alone.

  /// The share of light that passes, cell by cell.
  float transmittance(const GasPath& path) const;
  /// Where the way has passed `share` of the opacity 1 - `transmittance` of all of it [m].
  float distanceAtOpacity(const GasPath& path, float transmittance, float share) const;
  /// Where light going this way is absorbed or scattered first, drawn by delta tracking (Woodcock et al. 1965) with the
  /// largest density of each block; nothing when it passes. [m]
  std::optional<float> collision(const GasPath& path, NumberRun& numbers) const;

  /// What a block's gas gives off: the integral of extinction times glow over its cells, [radiance m2].
  const Grid3<Vec3f>& blockGlow() const { return blockGlow_; }
  /// [1/m], mean over the block's cells (blocks at the upper ends of the volume may have fewer).
  const Grid3<float>& blockExtinction() const { return blockExtinction_; }

 private:
  Vec3f arriving(const Vec3f& place, const std::vector<LightSource>& lights) const;
  void summariseBlock(const ParticleVolume& volume, int i, int j, int k);
  void pack(const ParticleVolume& volume);
  void packBrick(const ParticleVolume& volume, GasBrick& brick) const;
  void boundOccupied();
  void bakeScattered();
  void bakeBrick(GasBrick& brick) const;
  Vec3i blockAt(std::int32_t number) const;
  // The loops themselves, compiled for the processor at hand by their callers.
  template <class Use>
  void alongSteps(GasPath path, const Use& use) const;
  void look(const GasPath& path, GasSteps& steps) const;
  GasPassage marchHere(const GasPath& path) const;
  std::optional<float> collisionHere(GasPath path, NumberRun& numbers) const;
  float roughTransmittanceHere(GasPath path) const;
  template <class Read>
  void marchPackets(std::span<const GasPath> paths, std::span<GasPassage> passages) const;
  template <class Read>
  void marchPacket(std::span<const GasPath> paths, std::span<GasPassage> passages) const;
  void enter(std::span<const GasPath> paths, GasWays& ways) const;
  void look(const GasWays& ways, GasWaySteps& steps) const;
  void pass(const GasWaySteps& steps, GasWays& ways) const;
  void shine(const GasWaySteps& steps, GasWays& ways) const;
  bool clip(GasPath& path) const;

  Vec3i size_;      ///< [cells]
  float cellSize_;  ///< [m]
  BrickMemory memory_;
  std::vector<std::int32_t> brickOf_;  ///< by block; -1 where there is no gas
  std::int32_t brickCount_ = 0;
  GasOptics optics_;
  float step_;                    ///< [m]
  Vec3f origin_, lower_, upper_;  ///< [m] sample (0, 0, 0), and the box of the blocks that hold gas
  Grid3<float> blockExtinction_;
  Grid3<float> blockLargest_;  ///< density no cell of the block exceeds, its rim of neighbours included
  Grid3<Vec3f> blockGlow_;
  Grid3<Vec3f> blockScattered_;  ///< radiance that fully opaque gas there scatters
};

}  // namespace brisance
