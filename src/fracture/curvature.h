// How strong a surface is where: flat is strong, curved is weak (thesis 4.2.2, with the rules that make it well posed).
#pragma once

#include "fracture/fracture_graph.h"
#include "fracture/fracture_settings.h"

namespace brisance {

/// Per vertex K = A / (3 max(|delta|, 1e-4)) [m2], the reciprocal of the Gaussian curvature: A is the area of the
/// triangles around it, delta = 2 pi minus the sum of their angles there (pi minus the sum at a border). Always above
/// 0. `clipped` holds K between its 5th and 95th percentile, which keeps the noise of scanned meshes from deciding.
std::vector<double> vertexStrength(const TriangleMesh& mesh, CurvatureWeights weights);

/// What the spectral partitioners cut: the vertices that triangles use, and the edges between them.
struct VertexGraph {
  FractureGraph graph;                  ///< places are those of the vertices
  std::vector<std::uint32_t> vertexOf;  ///< mesh vertex of each node, rising
  std::vector<Triangle> triangles;      ///< those asked for, by their nodes
};

/// Builds the vertex graphs of parts of one mesh, whose edges are as strong in each part as in the whole.
class VertexGraphs {
 public:
  VertexGraphs(const TriangleMesh& mesh, const Curvature& curvature);  ///< (K_a + K_b) / 2 [m2]
  VertexGraphs(const TriangleMesh& mesh, const Spectral& spectral);    ///< 1, or the length of the edge [m]
  VertexGraph whole();
  /// Of some triangles of the mesh.
  VertexGraph of(std::span<const std::uint32_t> triangles);

 private:
  enum class Rule { meanStrength, unit, length };
  VertexGraphs(const TriangleMesh& mesh, Rule rule);
  double weight(std::uint32_t a, std::uint32_t b) const;

  const TriangleMesh& mesh_;
  Rule rule_;
  std::vector<double> strength_;       ///< of vertices, for the rule of their mean
  double leastLength_ = 0;             ///< [m] what an edge of no length counts as
  std::vector<std::uint32_t> nodeOf_;  ///< scratch: node of a mesh vertex in the graph at hand
};

VertexGraph vertexGraph(const TriangleMesh& mesh, const Curvature& curvature);
VertexGraph vertexGraph(const TriangleMesh& mesh, const Spectral& spectral);

}  // namespace brisance
