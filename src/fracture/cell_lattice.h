// Space in whole numbers: seeds of cells on a coarse lattice, vertices on a fine one, so that every question of side
// has an exact answer in few bits.
#pragma once

#include "base/random.h"
#include "mesh/lattice_points.h"

namespace brisance {

using Vec3l = Vec3<std::int64_t>;

/// Thrown where an exact answer is zero (a vertex on a plane, four planes through one point): the lattice is shaken and
/// the work begins again.
struct Coincidence {};

/// Whether `value` is above zero; never zero.
template <class Number>
bool isPositive(const Number& value) {
  if (value == 0) throw Coincidence{};
  return value > 0;
}

/// The longest side of a body's box is 2^18 seed steps, each of 2^22 vertex steps. Bits that follow: a vertex's power
/// distance to a seed, less the square that all share, fits 61 bits; a product of two such 123, of three 185.
constexpr int seedBits = 18, vertexBits = 22;

/// `shake` moves seeds by up to two seed steps and vertices by up to 32 vertex steps (7e-12 of the box), to bring what
/// lies on lattices of its own (boxes, coplanar faces) into general position. Equal places move alike.
class CellLattice {
 public:
  CellLattice(const Box3& box, std::uint64_t shake);

  Vec3l seed(const Vec3d& place, std::uint64_t index) const;
  Vec3l vertex(const Vec3d& place) const;
  /// Of a point in seed steps [m].
  Vec3d place(const Vec3d& point) const { return middle_ + point * step_; }
  Vec3d inSeedSteps(const Vec3d& place) const { return (place - middle_) / step_; }

 private:
  Random random_;
  Vec3d middle_;
  double step_;  ///< [m] of seeds
};

}  // namespace brisance
