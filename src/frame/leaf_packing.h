// Bricks as a VDB file holds its leaves: made, hashed and packed by several threads at once, one at a time in each.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/raw_bytes.h"
#include "grid/brick_source.h"

namespace brisance {

/// One bit for each sample of a leaf, k running fastest: set where the sample differs from the background.
using LeafMask = std::array<std::uint64_t, 8>;

/// The leaves of a grid in the order in which OpenVDB walks over them; bricks of nothing but background are none.
/// Whatever differs from the background by a single bit is active: inactive samples are kept as the background alone.
struct PackedLeaves {
  std::vector<Vec3i> corners;
  std::vector<LeafMask> masks;
  /// The leaves one after the other, in pieces of several: mask, the sign that inactive samples are the background, and
  /// the active samples, packed by Blosc (or as they are where that makes them no smaller).
  std::vector<RawBytes> pieces;
  std::string content;  ///< contentHash of the grid
};

template <class T>
PackedLeaves packLeaves(const BrickSource<T>& source);

/// Hash of a grid's place, background and values.
template <class T>
std::string contentHash(const BrickSource<T>& source);

}  // namespace brisance
