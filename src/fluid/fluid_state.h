// All that the next gas step needs.
#pragma once

#include <algorithm>

#include "fluid/fluid_settings.h"
#include "grid/mac_velocity.h"
#include "mesh/moving_solid.h"

namespace brisance {

/// Part of a face that a moving body closes. Gas there has the body's velocity.
struct BodyFace {
  int axis;
  int body;            ///< in SolidStamp::bodies
  Vec3i face;          ///< face[axis] counts faces, the others cells
  std::int64_t index;  ///< in the grid of the velocity component
  float share;         ///< of the whole face
};

/// What stands in the gas. Faces of the box itself count: a walled one is closed.
struct SolidStamp {
  Grid3<std::uint8_t> inside;         ///< 1: a cell without gas; all its faces are closed
  MacVelocity openShare;              ///< share of each face that lets gas through, 0 to 1
  std::vector<std::uint8_t> cutRows;  ///< by j + ny k: not all faces between the row's cells, or below them, are open
  Grid3<std::int32_t> region;         ///< connected gas, numbered from 0; -1: solid
  std::vector<std::uint8_t> sealed;   ///< by region: it reaches no open face of the box
  bool empty = true;                  ///< nothing stands in the gas: every face inside the box is wholly open
  std::vector<MovingSolid> bodies;    ///< that move, and gas with them
  std::vector<BodyFace> bodyFaces;    ///< ascending by axis and index

  int pocketCount() const { return static_cast<int>(std::count(sealed.begin(), sealed.end(), 1)); }
};

/// Scalars live at cell centres.
struct FluidState {
  MacVelocity velocity;      ///< [m/s] mean over the whole face: the gas' in the open part, the body's in the closed
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
