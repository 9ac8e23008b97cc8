// What the velocity still lacks, as a source for the solvers. Legend: h the cell size; b = h^2 (phi - div u) = h^2
// (-div grad) x; x = dt p.
#pragma once

#include <cmath>

#include "fluid/cell_field.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// Difference of the speeds at the faces of a cell: h div u.
inline double velocityDivergence(const MacVelocity& m, int i, int j, int k) {
  return (double(m.u(i + 1, j, k)) - m.u(i, j, k)) + (double(m.v(i, j + 1, k)) - m.v(i, j, k)) +
         (double(m.w(i, j, k + 1)) - m.w(i, j, k));
}

struct SourceNorms {
  double source = 0;    ///< |b|
  double rounding = 0;  ///< what |b| may be merely because velocities are rounded to single precision
};
/// b, plane by plane.
class VelocitySource {
 public:
  explicit VelocitySource(const FluidState& gas);
  /// Writes plane k to rows `stride` apart, zero in solids. Planes may come from several threads at once.
  void plane(int k, float* b, std::int64_t stride);
  /// Of all planes, once they are written.
  SourceNorms norms() const;

 private:
  struct Sums {
    double source = 0, speeds = 0;
  };
  const FluidState& gas_;
  std::vector<Sums> planes_;
};
/// Writes all of b.
SourceNorms computeSource(const FluidState& gas, CellField& b);
double fieldNorm(const CellField& field);

/// Sealed pockets, and the net source [m3/s] that was let go in them: the sum of its magnitudes.
struct PocketSources {
  int count = 0;
  double removed = 0;
};
/// Regions of gas, by number, that have no way out, nor a body that gives way.
using SealedRegions = std::vector<std::uint8_t>;

namespace detail {
struct PocketSum {
  double sum = 0, absolute = 0, cells = 0;
};
PocketSources judgePockets(const std::vector<PocketSum>& regions, const SealedRegions& sealed, double cellSize,
                           bool refuse);
}  // namespace detail

/// A pocket that no open face reaches can only be solved for a source whose sum is zero: takes its mean from at(i, j,
/// k), b, in all its cells. InputError where that is more than rounding and `refuse`.
template <class At>
PocketSources removePocketSources(const FluidState& gas, const SealedRegions& sealed, bool refuse, const At& at) {
  if (std::find(sealed.begin(), sealed.end(), 1) == sealed.end()) return {};
  std::vector<detail::PocketSum> regions(sealed.size());
  const Vec3i n = gas.pressure.size;
  const auto forPockets = [&](const auto& visit) {
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          if (const int region = gas.solid.region(i, j, k); region >= 0 && sealed[region])
            visit(regions[region], at(i, j, k));
  };
  forPockets([](detail::PocketSum& pocket, double b) {
    pocket.sum += b;
    pocket.absolute += std::abs(b);
    pocket.cells += 1;
  });
  const PocketSources sources = detail::judgePockets(regions, sealed, gas.pressure.cellSize, refuse);
  using Value = std::remove_reference_t<decltype(at(0, 0, 0))>;
  forPockets([](const detail::PocketSum& pocket, Value& b) { b = static_cast<Value>(b - pocket.sum / pocket.cells); });
  return sources;
}

}  // namespace brisance
