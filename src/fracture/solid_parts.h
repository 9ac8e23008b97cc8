// Which atoms make a piece where every piece has a cell of its own.
#pragma once

#include "fracture/cell_atoms.h"

namespace brisance {

/// The largest atom of each cell is a piece; every other joins the neighbour that it shares most area with. A part of
/// the body without any such becomes a piece of its own, and the smallest pieces join neighbours until there are
/// `pieces`. Fewer come out where cells are empty, more where the body has more parts than that.
Partition cellPieces(const CellAtoms& atoms, int pieces);

}  // namespace brisance
