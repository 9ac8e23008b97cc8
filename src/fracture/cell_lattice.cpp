#include "fracture/cell_lattice.h"

namespace brisance {
namespace {

/// From -2^(bits-1) to 2^(bits-1) - 1, out of random bits.
std::int64_t offset(std::uint64_t random, int shift, int bits) {
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  return static_cast<std::int64_t>((random >> shift) & mask) - (std::int64_t{1} << (bits - 1));
}

Vec3l shaken(const Vec3d& lattice, std::uint64_t random, int bits) {
  Vec3l result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = static_cast<std::int64_t>(std::floor(lattice[axis] + 0.5)) + offset(random, 20 * axis, bits);
  return result;
}

}  // namespace

CellLattice::CellLattice(const Box3& box, std::uint64_t shake)
    : random_(shake, Stream::solidCells), middle_((box.lower + box.upper) * 0.5) {
  const Vec3d size = box.size();
  // A little larger than the box, so that shaken vertices stay in range.
  step_ = std::max({size.x, size.y, size.z}) * (1 + 1e-6) / static_cast<double>(1 << seedBits);
}

Vec3l CellLattice::seed(const Vec3d& place, std::uint64_t index) const {
  constexpr int shakeBits = 2;
  return shaken(inSeedSteps(place), random_.bits(index), shakeBits);
}

Vec3l CellLattice::vertex(const Vec3d& place) const {
  constexpr int shakeBits = 6;
  const Vec3d fine = inSeedSteps(place) * static_cast<double>(1 << vertexBits);
  const Vec3l whole = shaken(fine, 0, 1);
  const auto hash = [&](std::uint64_t before, std::int64_t value) {
    return random_.bits(before ^ static_cast<std::uint64_t>(value));
  };
  return shaken(fine, hash(hash(hash(1, whole.x), whole.y), whole.z), shakeBits);
}

}  // namespace brisance
