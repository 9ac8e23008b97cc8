// Graphs and helpers that several tests of spectral partitions look at.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/random.h"
#include "fracture/fracture_graph.h"
#include "fracture/partition_facts.h"

namespace brisance {

/// The octahedron of thesis Figure 4.6.
inline TriangleMesh thesisExample() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {.5, .5, 1}, {1, 1, 0}, {0, 1, 0}, {.5, .5, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 2, 4}, {0, 1, 5}, {1, 3, 5}, {3, 4, 5}, {0, 4, 5}};
  return mesh;
}

/// The whole Modified Laplacian of thesis Definition 2.
inline std::vector<std::vector<double>> laplacian(const FractureGraph& graph) {
  const auto n = static_cast<std::uint32_t>(graph.nodeCount());
  std::vector<std::vector<double>> l(n, std::vector<double>(n, 0));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const double weight = graph.weights.empty() ? 1 : graph.weights[k];
      l[i][graph.targets[k]] -= weight;
      l[i][i] += weight;
    }
  return l;
}

/// A closed ring of n nodes: lambda_2 = 2 - 2 cos(2 pi / n), twice.
inline FractureGraph ring(std::uint32_t n) {
  FractureGraph graph;
  graph.first.push_back(0);
  for (std::uint32_t i = 0; i < n; ++i) {
    graph.targets.push_back((i + n - 1) % n);
    graph.targets.push_back((i + 1) % n);
    graph.first.push_back(static_cast<std::uint32_t>(graph.targets.size()));
  }
  return graph;
}

/// The surface of a cube of n x n squares a side, blown up to a sphere. Every square has a middle point, so that the
/// mesh has all symmetries of the cube.
inline TriangleMesh cubeSphere(int n) {
  TriangleMesh mesh;
  std::vector<std::pair<Vec3i, std::uint32_t>> known;
  const auto vertex = [&](const Vec3i& p) {
    for (const auto& [place, number] : known)
      if (place == p) return number;
    known.emplace_back(p, static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(normalized(Vec3d(p)));
    return known.back().second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-n, n})
      for (int i = -n; i < n; i += 2)
        for (int j = -n; j < n; j += 2) {
          const auto point = [&](int di, int dj) {
            Vec3i p;
            p[axis] = side;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            return vertex(p);
          };
          const std::uint32_t middle = point(1, 1);
          const std::array corners{point(0, 0), point(2, 0), point(2, 2), point(0, 2)};
          for (std::size_t c = 0; c < 4; ++c)
            mesh.triangles.push_back(side > 0 ? Triangle{corners[c], corners[(c + 1) % 4], middle}
                                              : Triangle{corners[(c + 1) % 4], corners[c], middle});
        }
  return mesh;
}

inline std::vector<int> pieceSizes(const Partition& partition) {
  std::vector<int> sizes(static_cast<std::size_t>(partition.count), 0);
  for (const int piece : partition.pieceOf) ++sizes.at(static_cast<std::size_t>(piece));
  return sizes;
}

/// The folder of the thesis' models, which are not the project's to ship.
inline std::optional<std::filesystem::path> thesisMeshes() {
  const char* named = std::getenv("BRISANCE_MESHES");
  for (const std::filesystem::path& folder :
       {std::filesystem::path(named ? named : ""), std::filesystem::path(BRISANCE_SOURCE_DIR) / "../shared/meshes",
        std::filesystem::path(BRISANCE_SOURCE_DIR) / "../../shared/meshes"})
    if (std::filesystem::exists(folder / "cow.obj")) return folder;
  return std::nullopt;
}

}  // namespace brisance
