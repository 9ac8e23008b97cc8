// The inner part of the particle volume: particles as shares of cells, spread and blurred row by row.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frame/particle_volume.h"

namespace brisance {

/// A Gaussian of 2 * radius + 1 weights that sum to one, with zeros around it so that loops may run over its ends.
class GaussianFilter {
 public:
  /// `deviation` in cells; a deviation of 0 leaves all as it is.
  GaussianFilter(double deviation, int radius);
  int radius() const { return radius_; }
  /// Weight at a distance in cells of at most `reach`.
  float operator()(int distance) const { return weights_[distance + centre_]; }
  const float* at(int distance) const { return weights_.data() + distance + centre_; }
  /// Cells that a particle's two neighbouring cells spread over, rounded up to whole vectors.
  int spread() const { return spread_; }
  /// One over the share of a cell's weights that stays inside, for each of `count` cells in a row.
  std::vector<float> gainInside(int count) const;

 private:
  int radius_, spread_, centre_;
  std::vector<float> weights_;
};

/// How a particle is shared between two neighbouring cells along an axis (one cell twice at the volume's face).
struct AxisShare {
  int lower = 0, upper = 0;
  float lowerWeight = 0, upperWeight = 0;
};

/// A particle as the volume sees it: mass, and mass times red, green and blue.
struct Splat {
  std::array<AxisShare, 3> share;
  std::array<float, 4> amount;
};

/// Splats ordered by the lower cell of their share along y.
struct SortedSplats {
  std::vector<Splat> splats;
  std::vector<std::uint32_t> rowStart;  ///< first splat of each row, and the end
};

/// Fills rows [firstRow, lastRow) along y of the volume, whose grids have their final size; every value is written.
void fillRows(const SortedSplats& sorted, const GaussianFilter& filter, int firstRow, int lastRow,
              ParticleVolume& volume);

}  // namespace brisance
