// A cut is made shorter and pieces more even by moving their border.
#pragma once

#include "fracture/fracture_graph.h"

namespace brisance {

enum class Balance {
  even,  ///< every piece close to the mean size
  keep   ///< every piece close to the size it has
};

/// Multilevel Fiduccia-Mattheyses (Fiduccia & Mattheyses 1982; Karypis & Kumar 1998): nodes of the same piece are
/// merged in pairs, again and again; then from the coarsest level to the finest, nodes on the border move where that
/// lowers the weight cut, first in blocks, at last one by one. No move leaves a piece in more islands than before, so
/// the number of pieces stays, and connected pieces stay connected. Serial where the order of moves matters: the
/// same for any number of threads.
Partition refineCut(const FractureGraph& graph, const Partition& partition, Balance balance = Balance::even);

}  // namespace brisance
