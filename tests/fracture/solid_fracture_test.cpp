#include "fracture/solid_fracture.h"

#include <gtest/gtest.h>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "fracture/breadth_first.h"
#include "fracture/solid_checker.h"
#include "fracture/solid_shapes.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

FractureSettings voronoi(int pieces, std::uint64_t seed = 1) {
  FractureSettings settings;
  settings.method = Voronoi{};
  settings.pieces = pieces;
  settings.seed = seed;
  settings.solid.enabled = true;
  return settings;
}
FractureSettings rough(int pieces, std::uint64_t seed = 1) {
  FractureSettings settings = voronoi(pieces, seed);
  settings.method = BreadthFirst{};
  return settings;
}

FracturedBody broken(const TriangleMesh& mesh, const FractureSettings& settings) {
  const CellPartitioner breadthFirst = [](const FractureGraph& graph, int pieces) {
    return partitionBreadthFirst(graph, pieces);
  };
  return fractureSolid(mesh, settings, {breadthFirst, {}, false});
}

TEST(SolidFracture, PiecesOfAllShapesAreSolidsThatMakeUpTheWhole) {
  for (const auto& [name, mesh] : solid_shapes::all()) {
    const double whole = solid_checker::volumeOf(mesh);
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const int pieces = 2 + static_cast<int>(seed % 13);
      const FractureSettings settings = seed % 2 ? voronoi(pieces, seed) : rough(pieces, seed);
      const FracturedBody body = broken(mesh, settings);
      ASSERT_EQ(solid_checker::fault(body, whole), "") << name << ", seed " << seed;
      ASSERT_EQ(body.pieces.size(), static_cast<std::size_t>(pieces)) << name << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace brisance
