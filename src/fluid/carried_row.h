// The donor-cell differences of donor_cell.h for rows of samples that lie anywhere, each face worked out once: what it
// gives the sample below it and what it gives the one above. The latter waits for that sample: along x in a register,
// along y and z in a row of its own.
#pragma once

#include <cmath>

#include "base/named_vectors.h"
#include "base/row_lines.h"
#include "fluid/fluid_settings.h"

namespace brisance {

inline float upwindWeightOf(const FluidSettings& settings) {
  return static_cast<float>(std::get<DonorCell>(settings.advection).upwindWeight);
}

/// Speeds at the faces above a row of samples, those along x from the first sample to the second on. Where two are
/// given, faces have their sum.
template <int speeds>
struct SpeedsAbove {
  const float* row[3][speeds];
};

/// A row of samples, its neighbours above, and what waits for it from the faces below.
struct SamplesAbove {
  const float *here, *above[3];
  float* waiting[3];  ///< along y and z; replaced by what waits for the rows above
};

/// A row of faces along y or z, for what waits at the begin of a sweep.
template <int speeds>
struct FaceRow {
  const float* speed[speeds];
  const float *below, *above;
};

/// By how much samples come towards their neighbours across faces, in units of the c of `carryRow`.
template <int floats, int speeds>
struct DonorPair {
  using V = NamedVectors<floats>;
  typename V::Type below, above;  ///< the sample below the face, and the one above it
  DonorPair(const float* const (&rows)[speeds], float upwindWeight, std::int64_t i) {
    typename V::Type speed = V::at(rows[0] + i), upwind;
    if constexpr (speeds == 2) speed += V::at(rows[1] + i);
    V::magnitude(speed, upwind);
    upwind *= upwindWeight;
    below = speed - upwind;
    above = speed + upwind;
  }
};

/// Samples [first, end) of a row of `count`. Both lie between lines of the cache, or at the row's ends.
struct RowPart {
  std::int64_t first, end, count;
};

/// Lets what a row of faces gives the samples above wait for them.
template <int floats, int speeds>
inline void awaitRow(const RowPart& part, const FaceRow<speeds>& face, float upwindWeight, float* waiting) {
  using V = NamedVectors<floats>;
  if constexpr (floats > 1)
    if (part.count < floats) return awaitRow<1>(part, face, upwindWeight, waiting);
  const auto block = [&](std::int64_t i, std::int64_t slot) {
    const DonorPair<floats, speeds> pair(face.speed, upwindWeight, i);
    V::at(waiting + slot) = pair.above * (V::at(face.above + i) - V::at(face.below + i));
  };
  std::int64_t i = part.first;
  for (; i + floats <= part.end; i += floats) block(i, i);
  if (i < part.end) block(part.count - floats, i);
}

/// s - dt (u . grad) s of a part of a row of samples of each field, for c = dt / (2 h speeds): calls
/// visit.operator()<floats>(i, s) for blocks of them, and before each fetch(i). Where the last block is not a whole
/// one, some samples are visited twice; what waits for it has a place of its own.
template <int floats, int speeds, int fields, class Fetch, class Visit>
inline void carryRow(const RowPart& part, const SpeedsAbove<speeds>& speedsAbove, const SamplesAbove (&samples)[fields],
                     float upwindWeight, float c, const Fetch& fetch, const Visit& visit) {
  using V = NamedVectors<floats>;
  using Vector = typename V::Type;
  if constexpr (floats > 1)
    if (part.count < floats) return carryRow<1>(part, speedsAbove, samples, upwindWeight, c, fetch, visit);
  Vector before[fields];  // what the faces along x before a block give it, in the last number
  const auto begin = [&](std::int64_t i) {
    float speed = speedsAbove.row[0][0][i - 1];
    if constexpr (speeds == 2) speed += speedsAbove.row[0][1][i - 1];
    const float share = speed + upwindWeight * std::abs(speed);
    for (int n = 0; n < fields; ++n)
      before[n] = Vector{} + share * (samples[n].above[0][i - 1] - samples[n].here[i - 1]);
  };
  const auto block = [&](std::int64_t i, std::int64_t slot) {
    fetch(i);
    const DonorPair<floats, speeds> x(speedsAbove.row[0], upwindWeight, i), y(speedsAbove.row[1], upwindWeight, i),
        z(speedsAbove.row[2], upwindWeight, i);
    Vector carried[fields];
#pragma GCC unroll 4
    for (int n = 0; n < fields; ++n) {
      const SamplesAbove& s = samples[n];
      const Vector here = V::at(s.here + i), riseX = V::at(s.above[0] + i) - here, riseY = V::at(s.above[1] + i) - here,
                   riseZ = V::at(s.above[2] + i) - here;
      const Vector next = x.above * riseX;
      Vector alongX;
      V::shift(before[n], next, alongX);
      alongX += x.below * riseX;
      const Vector alongY = y.below * riseY + V::at(s.waiting[1] + slot),
                   alongZ = z.below * riseZ + V::at(s.waiting[2] + slot);
      before[n] = next;
      V::at(s.waiting[1] + slot) = y.above * riseY;
      V::at(s.waiting[2] + slot) = z.above * riseZ;
      carried[n] = here - c * ((alongX + alongY) + alongZ);
    }
    visit.template operator()<floats>(i, carried);
  };
  const std::int64_t end = part.end;
  std::int64_t i = part.first;
  begin(i);
#pragma GCC unroll 1
  for (; i + floats <= end; i += floats) block(i, i);
  if (i == end) return;
  begin(part.count - floats);
  block(part.count - floats, i);
}

}  // namespace brisance
