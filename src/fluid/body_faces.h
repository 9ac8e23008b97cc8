// Which moving body closes a face, and how much of it.
#pragma once

#include "fluid/solid_lattice.h"

namespace brisance {

struct BodyFaceSearch {
  const FluidSettings& settings;
  const LatticeBox& box;
  const SolidLattice &fixed, &all;  ///< without the moving bodies, and with them
};

/// Shares out what is closed of each face among the bodies that cover or cross it, in the measure in which they do.
/// What closed for lack of gas in a cell goes to the body that took most of that cell. Walls of the box are no body's.
std::vector<BodyFace> sharesOfBodies(const BodyFaceSearch& search, const std::vector<BodyCut>& moving,
                                     const RowSet& rows, const MacVelocity& openShare);

}  // namespace brisance
