// What accelerates gas besides pressure.
#pragma once

#include "fluid/fluid_state.h"

namespace brisance {

/// Adds dt [s] times the external force and the buoyancy of hot gas (Boussinesq: upward per kelvin above ambient).
void addForces(FluidState& gas, const FluidSettings& settings, double dt);

/// Speed gained over dt [s] by the buoyancy at a row of faces along y: by the mean of the temperatures below and above,
/// of the nearest cells at the box's faces, or around a periodic box.
struct Lift {
  Lift(const Grid3<float>& temperature, const FluidSettings& settings, double dt, int j, int k);
  float operator()(std::int64_t i) const {
    float gained = 0;
    between(below[i], above[i], gained);
    return gained;
  }
  /// Between two temperatures [K], or vectors of them.
  template <class T>
  void between(const T& one, const T& other, T& gained) const {
    gained = perKelvin * (0.5f * (one + other) - ambient);
  }

  const float *below, *above;  ///< [K]
  float perKelvin, ambient;    ///< [m/(s K)], [K]
};

/// Brings the gas inside each stirring cylinder towards the speed of a turning solid.
void stir(FluidState& gas, const FluidSettings& settings, double dt);

}  // namespace brisance
