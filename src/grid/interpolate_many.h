// Values between the samples of a grid at many places at once.
#pragma once

#include <span>

#include "grid/grid3.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// Some places, one array per axis, so that loops over them become loops over vectors.
struct PlaceBlock {
  static constexpr int most = 256;
  double along[3][most];  ///< [m]
};

/// Trilinear values at `count` places, in single precision; beyond the samples the nearest ones hold. The same bits
/// with any vectors.
void interpolateMany(const Grid3<float>& grid, const PlaceBlock& places, int count, float* values);

/// Velocities at some places.
struct WindBlock {
  float along[3][PlaceBlock::most];  ///< [m/s]
};

/// The same for the components of a velocity, which share half of their cells along the axes.
void interpolateMany(const MacVelocity& velocity, const PlaceBlock& places, int count, WindBlock& wind);

/// The same for any number of places.
void interpolateMany(const Grid3<float>& grid, std::span<const Vec3d> places, float* values);

}  // namespace brisance
