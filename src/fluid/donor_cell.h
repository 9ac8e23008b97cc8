// Donor-cell differences of what the gas carries, one row at a time: h (u . grad) s, written as the fluxes through a
// sample's control volume less s times what they carry in all, so that a constant stays constant where div u is not
// zero. Griebel, Dornseifer & Neunhoeffer 1998, eq. 3.19.
#pragma once

#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"

namespace brisance {

/// Flux of a quantity between two samples, carried at `speed` from left to right where positive. The weight is 0 for
/// central differences, 1 for upwind, -1 for downwind.
inline float donorFlux(float speed, float left, float right, float upwindWeight) {
  return 0.5f * (speed * (left + right) - upwindWeight * std::abs(speed) * (right - left));
}

/// A row of samples, and how far the next sample along each axis is.
struct Row {
  const float* at;
  std::int64_t step[3];
};
inline Row rowOf(const PaddedGrid& grid, int j, int k) {
  return {grid.row(j, k), {1, grid.values.stride(1), grid.values.stride(2)}};
}

/// At the two sides of a control volume along one axis.
struct Sides {
  float lower, upper;
};
/// What the fluxes through both sides take from a sample, less the sample times what they carry in all: h (u ds/dx) of
/// the same scheme. `difference`: of the sample and its neighbours, upper less lower.
inline float donorDifference(Sides speed, Sides difference, float upwindWeight) {
  return 0.5f * ((speed.upper - upwindWeight * std::abs(speed.upper)) * difference.upper +
                 (speed.lower + upwindWeight * std::abs(speed.lower)) * difference.lower);
}
inline float donorRate(const Row& s, std::int64_t i, int axis, Sides speed, float upwindWeight) {
  const float lower = s.at[i - s.step[axis]], here = s.at[i], upper = s.at[i + s.step[axis]];
  return donorDifference(speed, {here - lower, upper - here}, upwindWeight);
}

/// How gas carries the velocity component along `axis`: its control volume reaches from centre to centre of two cells,
/// and each of its sides has the mean of the two speeds beside it.
template <int axis>
class SpeedFlow {
 public:
  SpeedFlow(const PaddedVelocity& carrier, const Grid3<float>& open) : carrier_(carrier), open_(open) {}
  Vec3i size() const { return open_.size; }

  struct FlowRow {
    Row w[3];
    const float* open;
    bool closed(std::int64_t i) const { return !(open[i] > 0); }
    float rate(const Row& s, std::int64_t i, float upwindWeight) const {
      return (donorRate(s, i, 0, sides<0>(i), upwindWeight) + donorRate(s, i, 1, sides<1>(i), upwindWeight)) +
             donorRate(s, i, 2, sides<2>(i), upwindWeight);
    }

   private:
    template <int b>
    Sides sides(std::int64_t i) const {
      const float* at = w[b].at + i;
      const std::int64_t back = -w[b].step[axis], up = w[b].step[b];
      if constexpr (b == axis) return {0.5f * (at[back] + at[0]), 0.5f * (at[0] + at[up])};
      return {0.5f * (at[back] + at[0]), 0.5f * (at[back + up] + at[up])};
    }
  };
  FlowRow row(int j, int k) const {
    return {
        {rowOf(carrier_.component[0], j, k), rowOf(carrier_.component[1], j, k), rowOf(carrier_.component[2], j, k)},
        open_.values.data() + open_.index(0, j, k)};
  }

 private:
  const PaddedVelocity& carrier_;
  const Grid3<float>& open_;
};

/// How gas carries a scalar of its cells.
class ScalarFlow {
 public:
  explicit ScalarFlow(const FluidState& gas) : velocity_(gas.velocity), inside_(gas.solid.inside) {}
  Vec3i size() const { return inside_.size; }

  struct FlowRow {
    const float *u, *v, *vUpper, *w, *wUpper;
    const std::uint8_t* inside;
    bool closed(std::int64_t i) const { return inside[i] != 0; }
    float divergence(std::int64_t i) const { return (u[i + 1] - u[i]) + (vUpper[i] - v[i]) + (wUpper[i] - w[i]); }
    float rate(const Row& s, std::int64_t i, float upwindWeight) const {
      return (donorRate(s, i, 0, {u[i], u[i + 1]}, upwindWeight) +
              donorRate(s, i, 1, {v[i], vUpper[i]}, upwindWeight)) +
             donorRate(s, i, 2, {w[i], wUpper[i]}, upwindWeight);
    }
  };
  FlowRow row(int j, int k) const {
    const auto at = [](const Grid3<float>& g, int jj, int kk) { return g.values.data() + g.index(0, jj, kk); };
    const MacVelocity& m = velocity_;
    return {at(m.u, j, k), at(m.v, j, k),     at(m.v, j + 1, k),
            at(m.w, j, k), at(m.w, j, k + 1), inside_.values.data() + inside_.index(0, j, k)};
  }

 private:
  const MacVelocity& velocity_;
  const Grid3<std::uint8_t>& inside_;
};

}  // namespace brisance
