// A cell whose centre lies in a solid may still hold gas. Its gas is known by a point: two neighbouring cells exchange
// gas only where the segment between their points meets no surface. So gas never finds a way that does not exist,
// however thin what stands there, and a wall that cuts a cell is no step.
#pragma once

#include "fluid/triangle_bins.h"

namespace brisance {

enum class CellGas : std::uint8_t {
  atCentre,  ///< the point is the cell's centre
  beside,    ///< elsewhere in the cell
  none       ///< the cell is solid
};

/// The point of one cell that is not at its centre.
struct GasPoint {
  int i;        ///< cell of the row
  Vec3d place;  ///< in cells
};

/// What is asked about the cells around one whose centre is in a solid.
struct GasPointSearch {
  const Surfaces& surfaces;
  const Grid3<std::uint8_t>& centreInside;
};

/// Looks for gas in a cell whose centre is in a solid, where the centres of neighbours in gas see it; false where there
/// is none. Mirrored solids give the mirrored point.
bool findGasPoint(const GasPointSearch& search, const Vec3i& cell, Vec3d& point);

}  // namespace brisance
