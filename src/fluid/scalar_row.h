// What the sweep over temperature, soot and flame works with.
#pragma once

#include <algorithm>
#include <utility>

#include "base/row_sum.h"
#include "fluid/changing_spans.h"
#include "fluid/made_rows.h"

namespace brisance {

/// Of the heat above ambient, and the largest temperature; in K, `created` and `outward` in K m/s.
struct HeatSums {
  double gained = 0, heated = 0, radiated = 0, created = 0, outward = 0, hottest = 0;
  void operator+=(const HeatSums& o) {
    gained += o.gained;
    heated += o.heated;
    radiated += o.radiated;
    created += o.created;
    outward += o.outward;
    hottest = std::max(hottest, o.hottest);
  }
};

constexpr int scalarFields = 3;  // temperature, soot, flame

/// What one thread needs: rows that are made, what waits for samples, sums.
struct ScalarRoom {
  ScalarRoom(int length, int rows)
      : old(length, 2 * scalarFields),
        first(length, scalarFields),
        beyond(length, 3 * scalarFields),
        planeEnd(length, scalarFields * rows),
        rowEnd(length, scalarFields),
        gained(length),
        heated(length),
        radiated(length),
        created(length),
        hottest(length) {}
  /// Of a field: what waits along y for its next row, along z for row `row` of the next plane.
  float* waiting(int field, int axis, int row) {
    return axis == 1 ? rowEnd[field] : planeEnd[scalarFields * row + field];
  }
  /// What the rows since the last time hold.
  HeatSums take() {
    return {gained.take(), heated.take(), radiated.take(), created.take(), std::exchange(outward, 0.0), hottest.take()};
  }

  Rooms old, first, beyond, planeEnd, rowEnd;
  int held = -1;  ///< the last row of a plane copied to `old`
  RowSum gained, heated, radiated, created;
  RowMax hottest;
  double outward = 0;
};

/// A row of cells and where its scalars are, which are replaced.
struct ScalarRow {
  int j, k;
  RowSpan span;                              ///< what changes
  const float* old[scalarFields];            ///< copies, with ghosts at their ends
  const float *lowerFace[3], *upperFace[3];  ///< speeds at the two sides of cells along each axis
  const std::uint8_t* inside;                ///< null: no cell is solid
  const float *heatRate, *burnRate;
  float *temperature, *soot, *flame;
  /// Times the size of a cell.
  float divergence(std::int64_t i) const {
    return (upperFace[0][i] - lowerFace[0][i]) + (upperFace[1][i] - lowerFace[1][i]) +
           (upperFace[2][i] - lowerFace[2][i]);
  }
};

/// Of a row, before and after it was carried.
struct Warmth {
  bool any;      ///< whether a cell is not at the ambient temperature: if none is, no heat came or went
  bool changes;  ///< whether a cell may be heated or cool
};
/// Of the cells of each place in a block, bits of which any tells.
struct WarmthByPlace {
  alignas(64) std::int32_t wasWarm[lineFloats] = {}, changes[lineFloats] = {};
  Warmth ofAll() const {
    std::int32_t before = 0, after = 0;
    for (int n = 0; n < lineFloats; ++n) {
      before |= wasWarm[n];
      after |= changes[n];
    }
    return {(before | after) != 0, after != 0};
  }
};
}  // namespace brisance
