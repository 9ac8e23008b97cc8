// What happens to the heat of a row of cells, for loops over wide vectors.
#pragma once

#include <bit>
#include <cstdint>

#include "base/lane_sum.h"
#include "fluid/fluid_settings.h"

namespace brisance {

/// y^(-1/3) for y >= 1, to the rounding of single precision: Newton's iteration from a guess by the exponent.
inline float inverseCubeRoot(float y) {
  constexpr float thirdOfBits = 1.0f / 3;
  constexpr std::int32_t guess = 0x54a23000;  // four thirds of the bits of 1, less what halves the largest error
  const auto third = static_cast<std::int32_t>(static_cast<float>(std::bit_cast<std::int32_t>(y)) * thirdOfBits);
  float z = std::bit_cast<float>(guess - third);
  for (int step = 0; step < 3; ++step)
    z += z * (1.0f / 3) * (1 - y * (z * z * z));  // 3.5 % -> 0.3 % -> 1e-5 -> rounding
  return y == 1 ? 1.0f : z;
}

/// Heats by the source and cools by radiation (temperature.h), cell by cell. Legend: T [K], H [K/s].
class HeatRow {
 public:
  HeatRow(const FluidSettings& s, double dt)
      : dt_(static_cast<float>(dt)),
        ambient_(static_cast<float>(s.ambientTemperature)),
        perRange_(static_cast<float>(1 / (s.maximumTemperature - s.ambientTemperature))),
        cooling_(static_cast<float>(3 * dt * s.coolingRate / (s.maximumTemperature - s.ambientTemperature))) {}

  float heated(float T, float H) const { return T + dt_ * H; }
  float cooled(float T) const {
    const float above = T - ambient_, x = above * perRange_;
    const float left = ambient_ + above * inverseCubeRoot(1 + cooling_ * (x * x * x));
    return above > 0 ? left : T;
  }

  struct Sums {
    double heated = 0, radiated = 0;  ///< [K] over the row
  };
  /// `room` holds as many floats.
  Sums operator()(float* T, const float* H, const std::uint8_t* inside, int count, float* room) const {
    const HeatRow row = *this;  // which no store changes
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const float before = T[i], hot = row.heated(before, H[i]), warm = row.cooled(hot);
      room[i] = inside[i] ? 0 : hot - warm;
      T[i] = inside[i] ? before : warm;
    }
    return {dt_ * laneSum(count,
                          [&](std::int64_t i) {
                            const float rate = H[i];
                            return inside[i] ? 0 : rate;
                          }),
            laneSum(count, [&](std::int64_t i) { return room[i]; })};
  }

 private:
  float dt_, ambient_, perRange_, cooling_;
};

}  // namespace brisance
