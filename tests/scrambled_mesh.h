// The same surface with its lists in another order.
#pragma once

#include <numeric>

#include "base/random.h"
#include "mesh/triangle_mesh.h"

namespace brisance {

inline std::vector<std::uint32_t> shuffledNumbers(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const Random random(seed, Stream::test);
  for (std::size_t n = count; n > 1; --n) std::swap(numbers[n - 1], numbers[random.below(n, n)]);
  return numbers;
}

struct ScrambledMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> triangleOf;  ///< per triangle, its number before
};

/// Vertices and triangles shuffled, and triangles begun at another of their corners.
inline ScrambledMesh scrambled(const TriangleMesh& mesh, std::uint64_t seed) {
  ScrambledMesh result;
  const auto vertexOrder = shuffledNumbers(mesh.vertices.size(), seed);
  std::vector<std::uint32_t> numberOf(mesh.vertices.size());
  for (std::uint32_t n = 0; n < vertexOrder.size(); ++n) {
    numberOf[vertexOrder[n]] = n;
    result.mesh.vertices.push_back(mesh.vertices[vertexOrder[n]]);
  }
  result.triangleOf = shuffledNumbers(mesh.triangles.size(), seed + 1);
  for (const std::uint32_t t : result.triangleOf) {
    const Triangle& old = mesh.triangles[t];
    const std::size_t turn = t % 3;
    result.mesh.triangles.push_back(
        {numberOf[old[turn]], numberOf[old[(turn + 1) % 3]], numberOf[old[(turn + 2) % 3]]});
  }
  return result;
}

}  // namespace brisance
