// Bodies for the tests of solids in gas.
#pragma once

#include "base/random.h"
#include "fluid/fluid_fixture.h"
#include "fluid/moving_solids.h"
#include "mesh/shapes.h"

namespace brisance::test {

inline MovingSolid solidAt(const Vec3d& centre, const TriangleMesh& mesh, const Quaternion& turned = {}) {
  MovingSolid solid;
  solid.mesh = std::make_shared<const TriangleMesh>(mesh);
  solid.pose = {centre, turned};
  return solid;
}
inline MovingSolid boxAt(const Vec3d& centre, const Vec3d& size, const Quaternion& turned = {}) {
  return solidAt(centre, boxMesh(size, false), turned);
}

/// The n-th of a family of rotations that has all orientations alike.
inline Quaternion anyOrientation(std::uint64_t n) {
  const Random random(11, Stream::test);
  return normalized(
      Quaternion{random.normal(4 * n), random.normal(4 * n + 1), random.normal(4 * n + 2), random.normal(4 * n + 3)});
}

/// Calls visit(axis, face, index, share) for every face.
template <class Visit>
void forFaces(const MacVelocity& share, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& grid = share.component(axis);
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) visit(axis, Vec3i{i, j, k}, grid.index(i, j, k), grid(i, j, k));
  }
}

/// Gives the gas one velocity wherever it may move.
inline void stream(FluidState& gas, const Vec3d& velocity) {
  forFaces(gas.solid.openShare, [&](int axis, const Vec3i&, std::int64_t index, float share) {
    gas.velocity.component(axis).values[index] = share * static_cast<float>(velocity[axis]);
  });
}

}  // namespace brisance::test
