// All that the next gas step needs.
#pragma once

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"

namespace brisance {

/// What stands in the gas. Faces of the box itself count: a walled one is closed.
struct SolidStamp {
  Grid3<std::uint8_t> inside;  ///< 1: the cell's centre lies in a solid
  MacVelocity openShare;       ///< share of each face that lets gas through: 0 or 1
  Grid3<std::int32_t>
      pocket;  ///< 0: gas that reaches an open face of the box; n > 0: the n-th sealed pocket; -1: solid
  int pocketCount = 0;
  bool empty = true;  ///< nothing stands in the gas: every face inside the box is wholly open
  friend bool operator==(const SolidStamp&, const SolidStamp&) = default;
};

/// Scalars live at cell centres.
struct FluidState {
  MacVelocity velocity;      ///< [m/s]
  Grid3<float> pressure;     ///< p / rho [m2/s2], the start of the next solve
  Grid3<float> temperature;  ///< [K]
  Grid3<float> soot;         ///< [kg/m3] carried by the gas
  Grid3<float> flame;        ///< [kg/m3] fuel burnt in the last moments, carried by the gas
  Grid3<float> divergence;   ///< phi [1/s]: rate of expansion
  Grid3<float> heatRate;     ///< H [K/s]
  Grid3<float> burnRate;     ///< fuel burnt [kg/(m3 s)], what soot and flame grow by
  SolidStamp solid;
};

/// Gas at rest (or with small random velocities) at ambient temperature.
FluidState makeFluid(const FluidSettings& settings, const SolidStamp& solid, std::uint64_t seed);

/// A grid of cell centres over the box.
template <class T>
Grid3<T> cellGrid(const FluidSettings& s, T value) {
  return {s.cells, s.corner + Vec3d(.5, .5, .5) * s.cellSize, s.cellSize, value};
}

}  // namespace brisance
