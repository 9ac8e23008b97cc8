// Cells whose plane faces replace the rough faces between pieces.
#pragma once

#include "fracture/cell_atoms.h"

namespace brisance {

/// Seeds of a power diagram, one per piece.
struct FlatCells {
  std::vector<Vec3d> seeds;     ///< [m] the pieces' centroids
  std::vector<double> weights;  ///< [m2]
};

/// Weights such that each plane passes through the middle of the face that it replaces, as nearly as least squares
/// weighted by area allow: |m - p_a|^2 - w_a = |m - p_b|^2 - w_b for the face of middle m between pieces a and b.
FlatCells flatCells(const CellAtoms& atoms, const Partition& pieces);

}  // namespace brisance
