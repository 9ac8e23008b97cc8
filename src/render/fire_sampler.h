// Places in the fire, drawn by how much they shine, so that fire lights the walls.
#pragma once

#include <vector>

#include "render/gas_medium.h"

namespace brisance {

struct FireSample {
  Vec3f place;     ///< [m]
  Vec3f emission;  ///< [radiance/m]
  float density;   ///< [1/m3]
};

/// Draws blocks of the gas by the luminance that leaves the gas from there, and places evenly within a block.
class FireSampler {
 public:
  explicit FireSampler(const GasMedium& gas);
  bool isDark() const { return upTo_.empty(); }
  /// Not to be called where it is dark.
  FireSample sample(float choice, const Vec2<float>& across, float along) const;
  /// With which density [1/m3] sample() draws the places of a block, by its number.
  float density(std::int32_t block) const { return densities_.values[block]; }

 private:
  const GasMedium& gas_;
  std::vector<Vec3i> blocks_;
  std::vector<double> upTo_;  ///< luminance of the blocks up to each
  Grid3<float> densities_;
};

}  // namespace brisance
