// A strip's rows of a few neighbouring planes, copied with their ghosts to memory of their own, where all start at
// lines of the cache.
#pragma once

#include "base/aligned.h"
#include "fluid/ghost_rows.h"
#include "fluid/sweep_strips.h"

namespace brisance {

/// Rows of `fields` fields, each of up to `length` samples, aligned to lines of the cache.
template <int fields, int planes>
class RowRing {
 public:
  RowRing(int length, int rowsPerStrip)
      : width_((length + lineFloats - 1) / lineFloats * lineFloats + 2 * lineFloats),
        rows_(rowsPerStrip + 3),
        floats_(static_cast<std::size_t>(width_) * rows_ * fields * planes, 0.0f) {}
  /// For another strip; nothing is kept.
  void begin(const SweepStrip& strip) {
    firstRow_ = strip.firstRow - 1;
    firstPlane_ = strip.firstPlane - 1;
  }

  /// From the row before the strip to the second after it.
  float* row(int field, int j, int k) {
    const int plane = (k + planes) % planes;
    return floats_.data() + lineFloats + std::int64_t{width_} * ((plane * fields + field) * rows_ + j - firstRow_);
  }
  /// Copies a row of a velocity component, of which the first is field 0, or makes one beyond the box.
  void fill(int component, const GhostRows& from, const MacVelocity& velocity, int j, int k) {
    float* to = row(component, j, k);
    if (from.has(j, k)) {
      from.copyRow(j, k, to);
      const GhostRows::CrossingRows rows = from.rowsOfCrossing(j, k);
      if (rows.jBefore >= firstRow_ && rows.kBefore >= firstPlane_)
        from.addEnds(
            rows, [&](int i, int jj, int kk) { return row(0, jj, kk)[i]; }, to);
      else
        from.addEnds(rows, velocity.u, to);
    } else if (const float* made = from.row(j, k, to); made != to) {
      std::copy_n(made, from.length(), to);
    }
  }

 private:
  int width_, rows_, firstRow_ = 0, firstPlane_ = 0;
  AlignedVector<float> floats_;
};

}  // namespace brisance
