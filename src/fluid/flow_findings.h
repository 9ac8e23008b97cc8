// What a look at the velocity finds, whoever made it: how well it obeys its source, what comes in and leaves, how fast
// it is.
#pragma once

#include <cmath>

#include "base/row_lanes.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// Sums over the cells of gas. The divergence is found in single precision: neighbouring speeds are alike, and what
/// their difference lacks is less than what rounded the speeds themselves.
struct FlowFindings {
  double wrong = 0;    ///< [1/s2] sum of (div u - phi)^2
  double source = 0;   ///< [1/s2] sum of phi^2
  double created = 0;  ///< [1/s] sum of phi
  double outward = 0;  ///< [m/s] sum of the speeds out of the box
  double fastest = 0;  ///< [m/s] largest of all cells' sum |u_i|, of the faster of two opposite faces along each axis

  void operator+=(const FlowFindings& o);
  /// |div u - phi| relative to |phi| (L2; absolute where phi is 0 everywhere)
  double error() const { return std::sqrt(wrong) / (source > 0 ? std::sqrt(source) : 1); }
};

/// Looks at a velocity row by row.
class FlowLook {
 public:
  explicit FlowLook(const FluidState& gas);
  /// Takes row (j, k) of cells into account, in wide vectors.
  void row(int j, int k);
  /// What the rows since the last time hold.
  FlowFindings take();

 private:
  struct Row {
    const float *u, *v, *vUpper, *w, *wUpper, *phi;
    const std::uint8_t* solids;  ///< null: no cell is solid
  };
  template <int floats, bool solids, bool sources>
  void addSums(const Row& row);
  double outwardAt(const Row& row, int j, int k) const;

  const FluidState& gas_;
  float perLength_;
  LaneTotal wrong_, source_, created_;
  Lanes fastest_{};
  double outward_ = 0;
};

FlowFindings lookAtFlow(const FluidState& gas);
/// Adds up what was found plane by plane, in order.
FlowFindings sumOf(const std::vector<FlowFindings>& planes);

}  // namespace brisance
