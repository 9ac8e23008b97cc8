// Bricks as a VDB file holds its leaves: packed by several threads at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grid/sparse_grid.h"

namespace brisance {

/// One bit for each sample of a leaf, k running fastest: set where the sample differs from the background.
using LeafMask = std::array<std::uint64_t, 8>;

/// Whatever differs from the background by a single bit is active: inactive samples are kept as the background alone.
template <class T>
std::vector<LeafMask> activeMasks(const SparseGrid<T>& grid);

/// The leaves of the bricks in `order`, one after the other in pieces of many: mask, the sign that inactive samples are
/// the background, and the active samples, packed by Blosc (or as they are where that makes them no smaller).
template <class T>
std::vector<std::string> packLeaves(const SparseGrid<T>& grid, const std::vector<LeafMask>& masks,
                                    std::span<const std::uint32_t> order);

}  // namespace brisance
