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
template <int floats>
struct DonorPair {
  using Vector = typename NamedVectors<floats>::Type;
  Vector below, above;  ///< the sample below the face, and the one above it
  DonorPair(const Vector& speed, float upwindWeight) {
    Vector upwind;
    NamedVectors<floats>::magnitude(speed, upwind);
    upwind *= upwindWeight;
    below = speed - upwind;
    above = speed + upwind;
  }
};

/// Sums of one or two rows.
template <int floats, int speeds>
inline void addSpeeds(const float* const (&rows)[speeds], std::int64_t i, typename NamedVectors<floats>::Type& speed) {
  using V = NamedVectors<floats>;
  speed = V::at(rows[0] + i);
  if constexpr (speeds == 2) speed += V::at(rows[1] + i);
}

/// The faces above a block of samples.
template <int floats>
struct DonorFaces {
  DonorPair<floats> x, y, z;
};

/// s - dt (u . grad) s of a block of samples. Legend: rise, to the neighbour above along each axis. `before` is what
/// the faces along x give the block after this one, in the last number; `waiting` as in SamplesAbove, at the block's
/// place.
template <int floats>
inline void carryBlock(const DonorFaces<floats>& faces, const typename NamedVectors<floats>::Type& here,
                       const typename NamedVectors<floats>::Type (&rise)[3], float c, float* waitingY, float* waitingZ,
                       typename NamedVectors<floats>::Type& before, typename NamedVectors<floats>::Type& carried) {
  using V = NamedVectors<floats>;
  const typename V::Type next = faces.x.above * rise[0];
  typename V::Type alongX;
  V::shift(before, next, alongX);
  alongX += faces.x.below * rise[0];
  const typename V::Type alongY = faces.y.below * rise[1] + V::at(waitingY),
                         alongZ = faces.z.below * rise[2] + V::at(waitingZ);
  before = next;
  V::at(waitingY) = faces.y.above * rise[1];
  V::at(waitingZ) = faces.z.above * rise[2];
  carried = here - c * ((alongX + alongY) + alongZ);
}

/// What a face along x gives the sample above it, in the last number. Legend: speed; samples below and above.
template <int floats>
inline void awaitAlongX(float speed, float below, float above, float upwindWeight,
                        typename NamedVectors<floats>::Type& before) {
  const float share = speed + upwindWeight * std::abs(speed);
  before = typename NamedVectors<floats>::Type{} + share * (above - below);
}

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
    typename V::Type speed;
    addSpeeds<floats>(face.speed, i, speed);
    const DonorPair<floats> pair(speed, upwindWeight);
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
    for (int n = 0; n < fields; ++n)
      awaitAlongX<floats>(speed, samples[n].here[i - 1], samples[n].above[0][i - 1], upwindWeight, before[n]);
  };
  const auto block = [&](std::int64_t i, std::int64_t slot) {
    fetch(i);
    Vector x, y, z, carried[fields];
    addSpeeds<floats>(speedsAbove.row[0], i, x);
    addSpeeds<floats>(speedsAbove.row[1], i, y);
    addSpeeds<floats>(speedsAbove.row[2], i, z);
    const DonorFaces<floats> faces{{x, upwindWeight}, {y, upwindWeight}, {z, upwindWeight}};
#pragma GCC unroll 4
    for (int n = 0; n < fields; ++n) {
      const SamplesAbove& s = samples[n];
      const Vector here = V::at(s.here + i),
                   rise[3] = {V::at(s.above[0] + i) - here, V::at(s.above[1] + i) - here, V::at(s.above[2] + i) - here};
      carryBlock<floats>(faces, here, rise, c, s.waiting[1] + slot, s.waiting[2] + slot, before[n], carried[n]);
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
