// Particles that are near one another in memory where they are near one another in space.
#pragma once

#include "base/counting_sort.h"
#include "grid/grid3.h"
#include "particles/particle_set.h"

namespace brisance {

/// Memory that sorting uses again.
struct OrderScratch {
  Binned<std::uint32_t> order;
  ParticleSet sorted;
};

/// Sorts particles by the row of cells (x fastest) in which they lie, so that what they read and write of a grid is
/// read once; those of one row keep their order. `cells` is any grid of cell centres.
void sortByRow(ParticleSet& particles, const Grid3<float>& cells, OrderScratch& scratch);

}  // namespace brisance
