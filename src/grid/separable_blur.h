// A separable filter over a field that is made layer by layer, sparse where nothing lies: heat of burning particles
// (one channel), mass and colour for pictures (four).
#pragma once

#include <functional>

#include "base/math.h"
#include "grid/layer_rows.h"
#include "grid/symmetric_filter.h"

namespace brisance {

/// A field of `channels` values per cell, side by side, blurred along all axes. It is made in strips of neighbouring
/// rows of all layers, one layer after the other, some rows in two strips, and handed out row by row; what lies in
/// between fits a cache.
struct BlurTask {
  Vec3i size;
  int channels = 1;  ///< 1, or a picture's 4, of which the bits may depend on the processor's vectors
  SymmetricFilter filter;
  /// Adds to the given rows, or those of them that the field has, of layer k (near) what completes them, and if it
  /// likes to those of layer k + 1 (far). Called for k = 0, 1, ... in turn. A row more on either side is there to be
  /// written, and not used.
  std::function<void(const CellSpan& rows, int k, LayerRows& near, LayerRows& far)> fill;
  /// Takes a piece of row (j, k), after those before it: cells outside `filled` are zero. `row` is the row's
  /// start, but of its cells only those of the piece and 16 before it are there. Together the pieces are all cells.
  std::function<void(int j, int k, const CellSpan& piece, const CellSpan& filled, const float* row)> finish;
  /// Called by each thread after the last piece of some rows.
  std::function<void()> finished = [] {};
};
/// The callbacks come from several threads at once, each for rows of its own.
void blurSeparably(const BlurTask& task);

}  // namespace brisance
