#include "fracture/partition.h"

#include "base/check.h"
#include "base/stopwatch.h"
#include "fracture/breadth_first.h"
#include "fracture/minimum_share.h"
#include "fracture/refine_cut.h"
#include "fracture/spectral.h"
#include "fracture/voronoi.h"
#include "mesh/canonical_order.h"

namespace brisance {
namespace {

/// Sizes are evened out where the method wants even pieces; others have the sizes that the shape gives them.
Balance balanceOf(const FractureMethod& method) {
  return std::holds_alternative<BreadthFirst>(method) || std::holds_alternative<BreadthFirstThesis>(method)
             ? Balance::even
             : Balance::keep;
}

void improve(const FractureGraph& graph, const FractureSettings& settings, Partition& partition) {
  if (settings.refine) partition = refineCut(graph, partition, balanceOf(settings.method));
  if (settings.minimumShare > 0) partition = enforceMinimumShare(graph, partition, settings.minimumShare);
  numberByLowestNode(partition);
}

/// Cells of a thin tip hang on by little, and would be cut off one by one: splinters that nobody sees.
constexpr double leastSpectralShare = 0.1;

struct GraphPartitioner {
  const FractureGraph& graph;
  const FractureSettings& settings;

  Cut operator()(const BreadthFirst&) const { return {partitionBreadthFirst(graph, settings.pieces)}; }
  Cut operator()(const Voronoi& cells) const {
    return {partitionVoronoi(graph, settings.pieces, cells, settings.seed)};
  }
  Cut operator()(const Curvature&) const { return {partitionSpectral(graph, settings.pieces)}; }
  Cut operator()(const Spectral&) const { return {partitionSpectral(graph, settings.pieces)}; }
  Cut operator()(const BreadthFirstThesis&) const {
    throw InputError(
        "fracture: breadth_first_thesis cuts triangles; solid pieces take breadth_first, curvature, spectral or "
        "voronoi");
  }
};

/// Centroids and areas, for cells of space.
void measureTriangles(const TriangleMesh& mesh, FractureGraph& graph) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    graph.places.push_back((p + q + r) / 3.0);
    graph.sizes.push_back(length(cross(q - p, r - p)) / 2);
  }
}

/// Cuts a surface in canonical order.
class SurfacePartitioner {
 public:
  SurfacePartitioner(const TriangleMesh& mesh, FractureGraph& triangles, const FractureSettings& settings)
      : mesh_(mesh), graph_(triangles), settings_(settings) {}

  template <class Method>
  Cut operator()(const Method& method) const {
    return GraphPartitioner{graph_, settings_}(method);
  }
  Cut operator()(const Voronoi& cells) const {
    measureTriangles(mesh_, graph_);
    return GraphPartitioner{graph_, settings_}(cells);
  }
  Cut operator()(const Curvature& curvature) const { return spectralCut(curvature); }
  Cut operator()(const Spectral& spectral) const { return spectralCut(spectral); }
  Cut operator()(const BreadthFirstThesis& method) const {
    return {partitionBreadthFirstThesis(mesh_, settings_.pieces, method.split)};
  }

 private:
  template <class Method>
  Cut spectralCut(const Method& method) const {
    SpectralPartition result = brisance::partitionSurface(mesh_, method, settings_.pieces);
    return {std::move(result.partition), std::move(result.eigenvalues)};
  }

  const TriangleMesh& mesh_;
  FractureGraph& graph_;  ///< of its triangles
  const FractureSettings& settings_;
};

}  // namespace

Cut partitionGraph(const FractureGraph& graph, const FractureSettings& asked) {
  const Stopwatch watch;
  FractureSettings settings = asked;
  if (std::holds_alternative<Curvature>(asked.method) || std::holds_alternative<Spectral>(asked.method))
    settings.minimumShare = std::max(asked.minimumShare, leastSpectralShare);
  Cut cut = std::visit(GraphPartitioner{graph, settings}, settings.method);
  improve(graph, settings, cut.partition);
  cut.partitionSeconds = watch.seconds();
  return cut;
}

Cut partitionSurface(const TriangleMesh& surface, const FractureSettings& settings) {
  Stopwatch watch;
  const OrderedSurface ordered = inCanonicalOrder(surface);
  FractureGraph graph = triangleGraph(ordered.mesh);
  checkPieceCount(graph, settings.pieces);
  const double graphSeconds = watch.lap();
  Cut cut = std::visit(SurfacePartitioner(ordered.mesh, graph, settings), settings.method);
  improve(graph, settings, cut.partition);
  cut.partitionSeconds = watch.seconds();
  cut.graphSeconds = graphSeconds;
  std::vector<int> pieceOf(surface.triangles.size());
  for (std::size_t t = 0; t < pieceOf.size(); ++t) pieceOf[ordered.triangleOf[t]] = cut.partition.pieceOf[t];
  cut.partition.pieceOf = std::move(pieceOf);
  return cut;
}

}  // namespace brisance
